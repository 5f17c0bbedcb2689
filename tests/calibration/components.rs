//! Constants of a covariance by weighted medians.
//!
//! An error `e` of two coordinates has the covariance `C = F + Σ θ_k A_k`, `F` and `A_k` known. If it is normal, `u = eᵀC⁻¹e`
//! is χ² with two degrees of freedom, whose median is 2 ln 2. Component `k` makes the share `w = θ_k tr(A_k C⁻¹)/2` of the
//! covariance. The fit is where, for every `k`, the median of `u` weighted with `w` is 2 ln 2: found by
//! `θ_k ← θ_k · median_k(u) / (2 ln 2)`. Medians bear tails: up to half of the weight may be wrong.

use nalgebra::{Matrix2, Vector2};
use opnav::stats::random_stream;
use rand::RngExt;
use rayon::prelude::*;

/// Median of χ² with two degrees of freedom.
pub const MEDIAN_2: f64 = 2.0 * std::f64::consts::LN_2;
/// Rounds of the fit, at most.
const ROUNDS: usize = 200;

/// An error with the parts of its covariance.
#[derive(Debug, Clone)]
pub struct Sample<const K: usize> {
    /// Errors of a group share scene and light: the bootstrap draws groups.
    pub group: usize,
    pub error: Vector2<f64>,
    pub fixed: Matrix2<f64>,
    pub parts: [Matrix2<f64>; K],
}

impl<const K: usize> Sample<K> {
    fn covariance(&self, theta: &[f64; K]) -> Matrix2<f64> {
        self.parts.iter().zip(theta).fold(self.fixed, |sum, (part, t)| sum + part * *t)
    }

    /// Normalised squared error.
    pub fn normalized(&self, theta: &[f64; K]) -> f64 {
        let inverse = self.covariance(theta).try_inverse().unwrap_or_else(Matrix2::zeros);
        self.error.dot(&(inverse * self.error))
    }
}

/// The components that make the weighted medians right, from `start`.
pub fn fit<const K: usize>(samples: &[&Sample<K>], start: [f64; K]) -> [f64; K] {
    let mut theta = start;
    for _ in 0..ROUNDS {
        let mut weighted: [Vec<(f64, f64)>; K] = std::array::from_fn(|_| Vec::with_capacity(samples.len()));
        for sample in samples {
            let Some(inverse) = sample.covariance(&theta).try_inverse() else { continue };
            let squared = sample.error.dot(&(inverse * sample.error));
            for k in 0..K {
                weighted[k].push((squared, 0.5 * theta[k] * (sample.parts[k] * inverse).trace()));
            }
        }
        let mut moved = 0f64;
        for k in 0..K {
            let ratio = (weighted_median(&mut weighted[k]) / MEDIAN_2).clamp(0.25, 4.0);
            theta[k] = (theta[k] * ratio).max(1e-6 * start[k]);
            moved = moved.max(ratio.ln().abs());
        }
        if moved < 1e-3 {
            break;
        }
    }
    theta
}

/// The value below which half of the weight lies.
pub fn weighted_median(values: &mut [(f64, f64)]) -> f64 {
    values.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let half = 0.5 * values.iter().map(|v| v.1).sum::<f64>();
    let mut below = 0.0;
    for (value, weight) in values.iter() {
        below += weight;
        if below >= half {
            return *value;
        }
    }
    f64::NAN
}

pub fn median(values: &[f64]) -> f64 {
    weighted_median(&mut values.iter().map(|v| (*v, 1.0)).collect::<Vec<_>>())
}

/// Robust standard deviation: 1.4826 times the median distance from the median.
pub fn robust_sigma(values: &[f64]) -> f64 {
    let middle = median(values);
    1.4826 * median(&values.iter().map(|v| (v - middle).abs()).collect::<Vec<_>>())
}

/// 95 % intervals of what `fit` makes of groups drawn with replacement (bootstrap), `rounds` times.
pub fn intervals<const K: usize>(
    groups: &[usize],
    (rounds, purpose): (usize, &str),
    fit: impl Fn(&[usize]) -> [f64; K] + Sync,
) -> [[f64; 2]; K] {
    let draw = |round: usize| {
        let mut random = random_stream(super::SEED, purpose, round as u64);
        let drawn: Vec<usize> = groups.iter().map(|_| groups[random.random_range(0..groups.len())]).collect();
        fit(&drawn)
    };
    let drawn: Vec<[f64; K]> = (0..rounds).into_par_iter().map(draw).collect();
    std::array::from_fn(|k| {
        let mut all: Vec<f64> = drawn.iter().map(|d| d[k]).filter(|v| v.is_finite()).collect();
        all.sort_unstable_by(f64::total_cmp);
        let at = |share: f64| all.get((share * (all.len().max(1) - 1) as f64).round() as usize).copied();
        [at(0.025).unwrap_or(f64::NAN), at(0.975).unwrap_or(f64::NAN)]
    })
}

/// A fit of components with its intervals, both as roots of the variances.
pub struct Fitted<const K: usize> {
    pub sigma: [f64; K],
    pub intervals: [[f64; 2]; K],
    pub samples: usize,
}

pub fn fit_with_intervals<const K: usize>(samples: &[Sample<K>], start_sigma: [f64; K], purpose: &str) -> Fitted<K> {
    let start = start_sigma.map(|s| s * s);
    let all: Vec<&Sample<K>> = samples.iter().collect();
    let best = fit(&all, start);
    let mut groups: Vec<usize> = samples.iter().map(|s| s.group).collect();
    groups.sort_unstable();
    groups.dedup();
    let by_group: Vec<Vec<&Sample<K>>> =
        groups.iter().map(|g| samples.iter().filter(|s| s.group == *g).collect()).collect();
    let places: Vec<usize> = (0..groups.len()).collect();
    let again = |drawn: &[usize]| {
        // A third of the samples tells as much of how the fit scatters from scene to scene.
        let some: Vec<&Sample<K>> = drawn.iter().flat_map(|g| by_group[*g].iter().step_by(3).copied()).collect();
        fit(&some, best).map(f64::sqrt)
    };
    Fitted { sigma: best.map(f64::sqrt), intervals: intervals(&places, (100, purpose), again), samples: samples.len() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_distr::{Distribution, StandardNormal};

    /// Errors of two components, of 0.02 px and of 1.5 times a known part, a share of them a hundred times as large.
    fn samples(wrong: f64, run: u64) -> Vec<Sample<2>> {
        let mut random = random_stream(5, "synthetic residuals", run);
        let sample = |index: usize| {
            let part = Matrix2::new(1.0, 0.3, 0.3, 0.7) * (1e-5 * 10f64.powf(3.0 * random.random::<f64>()));
            let parts = [Matrix2::identity(), part];
            let covariance = parts[0] * 0.02f64.powi(2) + parts[1] * 1.5f64.powi(2);
            let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
            let unit = Vector2::new(normal(), normal());
            let size = if random.random::<f64>() < wrong { 100.0 } else { 1.0 };
            let error = covariance.cholesky().expect("positive").l() * unit * size;
            Sample { group: index % 20, error, fixed: Matrix2::zeros(), parts }
        };
        (0..6000).map(sample).collect()
    }

    #[test]
    fn known_components_are_recovered_and_lie_in_their_intervals() {
        const RUNS: u64 = 12;
        let truth = [0.02, 1.5];
        let mut covered = [0; 2];
        for run in 0..RUNS {
            let found = fit_with_intervals(&samples(0.0, run), [0.1, 0.5], "test");
            for k in 0..2 {
                assert!((found.sigma[k] / truth[k] - 1.0).abs() < 0.1, "{:?}", found.sigma);
                let [low, high] = found.intervals[k];
                assert!(high / low < 1.5, "{:?}", found.intervals);
                covered[k] += u64::from(low < truth[k] && truth[k] < high);
            }
        }
        // Of twelve intervals of 95 %, nine or more hold the truth with a probability of 99.8 %.
        assert!(covered.iter().all(|c| *c >= 9), "{covered:?} of {RUNS}");
    }

    /// One error in twenty a hundred times too large hardly moves the medians, and ruins the mean.
    #[test]
    fn tails_move_the_fit_little_and_a_mean_much() {
        let spoilt = samples(0.05, 0);
        let all: Vec<&Sample<2>> = spoilt.iter().collect();
        let found = fit(&all, [0.01, 0.25]).map(f64::sqrt);
        assert!((found[0] / 0.02 - 1.0).abs() < 0.15 && (found[1] / 1.5 - 1.0).abs() < 0.15, "{found:?}");
        let truth = [0.02f64.powi(2), 1.5f64.powi(2)];
        let mean = all.iter().map(|s| s.normalized(&truth)).sum::<f64>() / all.len() as f64;
        assert!(mean > 100.0, "a mean follows the tails: {mean}");
    }

    /// A component that is left out is made up for by the other one, and the medians by part of the samples show it.
    #[test]
    fn a_missing_component_is_noticed() {
        let alone: Vec<Sample<1>> = samples(0.0, 0)
            .into_iter()
            .map(|s| Sample { group: s.group, error: s.error, fixed: s.fixed, parts: [s.parts[1]] })
            .collect();
        let all: Vec<&Sample<1>> = alone.iter().collect();
        let theta = fit(&all, [1.0]);
        let of = |small: bool| {
            let part = alone.iter().filter(|s| (s.parts[0].trace() < 1e-4) == small);
            median(&part.map(|s| s.normalized(&theta)).collect::<Vec<_>>()) / MEDIAN_2
        };
        assert!(of(true) > 1.5 && of(false) < 0.8, "{} {}", of(true), of(false));
    }

    #[test]
    fn the_same_seed_gives_the_same_intervals() {
        let groups: Vec<usize> = (0..12).collect();
        let mean = |drawn: &[usize]| [drawn.iter().sum::<usize>() as f64 / drawn.len() as f64];
        assert_eq!(intervals(&groups, (50, "a"), mean), intervals(&groups, (50, "a"), mean));
        assert_ne!(intervals(&groups, (50, "a"), mean), intervals(&groups, (50, "b"), mean));
    }
}
