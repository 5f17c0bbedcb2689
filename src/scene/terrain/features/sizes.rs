//! Diameters within one octave, as a table of quantiles.

/// Steps of the table; diameters between its entries are interpolated linearly.
const STEPS: usize = 16;

/// Quantiles of the diameters of one octave, over the smallest: from 1 to 2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sizes([f64; STEPS + 1]);

impl Sizes {
    /// Of features of which N(>D) ~ D^-`exponent`.
    pub(super) fn of_power_law(exponent: f64) -> Sizes {
        let share_of_octave = 1.0 - 0.5_f64.powf(exponent);
        Sizes(std::array::from_fn(|k| (1.0 - k as f64 / STEPS as f64 * share_of_octave).powf(-1.0 / exponent)))
    }

    /// Of features whose number a square metre between D and D + dD is `density_1_m2(D) dD/D`, and that number in the
    /// octave from `smallest_m`.
    pub(super) fn of_density(smallest_m: f64, density_1_m2: impl Fn(f64) -> f64) -> (Sizes, f64) {
        const PIECES: usize = 1024;
        let step = std::f64::consts::LN_2 / PIECES as f64;
        let mut numbers = vec![0.0];
        for k in 0..PIECES {
            let middle_m = smallest_m * ((k as f64 + 0.5) * step).exp();
            numbers.push(numbers[k] + density_1_m2(middle_m) * step);
        }
        let total = numbers[PIECES];
        let quantile = |k: usize| {
            let wanted = total * k as f64 / STEPS as f64;
            let after = numbers.partition_point(|n| *n < wanted).clamp(1, PIECES);
            let gained = numbers[after] - numbers[after - 1];
            let part = if gained > 0.0 { (wanted - numbers[after - 1]) / gained } else { 0.0 };
            (((after - 1) as f64 + part) * step).exp()
        };
        (Sizes(std::array::from_fn(quantile)), total)
    }

    /// Diameter over the smallest, for a share from 0 to 1 of smaller ones.
    pub(super) fn at(&self, share: f64) -> f64 {
        let scaled = share * STEPS as f64;
        let below = (scaled as usize).min(STEPS - 1);
        self.0[below] + (self.0[below + 1] - self.0[below]) * (scaled - below as f64)
    }
}
