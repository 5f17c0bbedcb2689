//! Shot noise: a whole number of electrons from the Poisson distribution.

use rand::{Rng, RngExt};
use rand_distr::{Distribution, StandardNormal};

/// Largest mean for which the distribution itself is drawn.
const LARGEST_EXACT_MEAN: f64 = 32.0;
/// No count is larger at such means: its probability is below 1e-80, so only rounding could lead there.
const LARGEST_EXACT_COUNT: f64 = 300.0;

/// Electrons counted where `mean` (finite) are expected; 0 for a mean of 0 or less.
///
/// Up to a mean of 32 by inversion of the distribution, which is exact. Above, the Cornish–Fisher expansion of its
/// quantiles to third order, rounded (Fisher and Cornish 1960): with a normal deviate z and σ² = mean - 1/12, so that
/// rounding restores the variance (Sheppard's correction), the count is mean + σ z + (z² - 1)/6 + (z - z³)/(72 σ).
pub(super) fn shot(mean: f64, random: &mut impl Rng) -> f64 {
    if mean <= 0.0 {
        return 0.0;
    }
    if mean <= LARGEST_EXACT_MEAN {
        return inverted(mean, random.random());
    }
    let z: f64 = StandardNormal.sample(random);
    let sigma = (mean - 1.0 / 12.0).sqrt();
    let square = z * z;
    let count = mean + sigma * z + (square - 1.0) / 6.0 + z * (1.0 - square) / (72.0 * sigma);
    (count + 0.5) as u64 as f64
}

/// The smallest count whose cumulated probability exceeds `uniform`, from 0 to 1.
fn inverted(mean: f64, uniform: f64) -> f64 {
    let (mut count, mut probability, mut rest) = (0.0, (-mean).exp(), uniform);
    while rest >= probability && count < LARGEST_EXACT_COUNT {
        rest -= probability;
        count += 1.0;
        probability *= mean / count;
    }
    count
}

#[cfg(test)]
mod tests {
    use super::shot;
    use crate::stats::random_stream;
    use rand::Rng;
    use statrs::distribution::{ChiSquared, ContinuousCDF, Discrete, Poisson};

    const DRAWS: usize = 400_000;

    /// Probability that draws of the stated distribution fit Poisson's no better, by Pearson's χ² over bins of 20 or
    /// more expected draws.
    fn fit(mean: f64, draw: impl Fn(f64, &mut dyn Rng) -> f64) -> f64 {
        let mut random = random_stream(3, "shot test", mean.to_bits());
        let law = Poisson::new(mean).expect("a positive mean");
        let largest = (mean + 12.0 * mean.sqrt() + 20.0) as usize;
        let mut counts = vec![0_usize; largest + 1];
        (0..DRAWS).for_each(|_| counts[(draw(mean, &mut random).max(0.0) as usize).min(largest)] += 1);
        let (mut chi_squared, mut bins, mut expected, mut found) = (0.0, 0, 0.0, 0.0);
        for (count, drawn) in counts.iter().enumerate() {
            expected += law.pmf(count as u64) * DRAWS as f64;
            found += *drawn as f64;
            if expected >= 20.0 {
                chi_squared += (found - expected) * (found - expected) / expected;
                bins += 1;
                (expected, found) = (0.0, 0.0);
            }
        }
        1.0 - ChiSquared::new(f64::from(bins - 1)).expect("bins").cdf(chi_squared)
    }

    #[test]
    fn counts_follow_poissons_law() {
        for mean in [0.05, 0.7, 3.0, 11.0, 31.9, 32.1, 60.0, 400.0] {
            let fit = fit(mean, |mean, mut random| shot(mean, &mut random));
            assert!(fit > 1e-3, "mean {mean}: probability {fit}");
        }
    }

    #[test]
    fn the_test_finds_wrong_laws() {
        for mean in [3.0, 31.9, 60.0] {
            let brighter = fit(mean, |mean, mut random| shot(1.01 * mean, &mut random));
            assert!(brighter < 1e-4, "mean {mean}, one per cent brighter: {brighter}");
            let normal = fit(mean, |mean, mut random| {
                let z: f64 = rand_distr::Distribution::sample(&rand_distr::StandardNormal, &mut random);
                (mean + mean.sqrt() * z).round()
            });
            assert!(normal < 1e-4, "mean {mean}, plain normal: {normal}");
        }
    }
}
