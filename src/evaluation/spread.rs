//! Figures that describe a set of numbers.

use crate::stats::quantile;

/// Percentile (`share` from 0 to 1) with linear interpolation between order statistics; `None` of nothing. Values that
/// are not numbers are left out.
pub fn percentile(values: &[f64], share: f64) -> Option<f64> {
    quantile(&mut values.iter().copied().filter(|v| !v.is_nan()).collect::<Vec<f64>>(), share)
}

/// Median; `None` of nothing.
pub fn median(values: &[f64]) -> Option<f64> {
    percentile(values, 0.5)
}

/// Root of the mean square; `None` of nothing.
pub fn root_mean_square(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    let (mut sum, mut count) = (0.0, 0usize);
    for value in values {
        sum += value * value;
        count += 1;
    }
    (count > 0).then(|| (sum / count as f64).sqrt())
}
