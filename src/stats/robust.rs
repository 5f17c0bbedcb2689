//! Order statistics, and measures of spread that a few outliers do not move.
//!
//! Every function selects within the slice that it is given: it reorders it, allocates nothing and takes linear time. Values
//! are in the order of [`f64::total_cmp`]: one that is no number counts like any other, beyond the infinite ones.

// The standard library's selection, not `statrs`' `OrderStatistics`: that gives NaN of nothing, where every caller has an
// answer of its own; its extremes become NaN by any NaN, its other ranks do not; and its quantiles are Hyndman and Fan's
// eighth definition, no longer those of results already written.

/// Median of |x| of a standard normal number, Φ⁻¹(3/4), to four digits (Rousseeuw and Croux, "Alternatives to the median
/// absolute deviation", 1993).
pub const NORMAL_MEDIAN: f64 = 0.6745;

/// Median length of a vector of two standard normal numbers, √(2 ln 2), to five digits (the Rayleigh distribution's).
pub const NORMAL_MEDIAN_2D: f64 = 1.1774;

/// Median squared length of a vector of three standard normal numbers: that of χ² with 3 degrees of freedom.
pub const SQUARED_NORMAL_MEDIAN_3D: f64 = 2.365_974;

/// 1σ of normal numbers over their median absolute deviation, 1 / Φ⁻¹(3/4), to five digits.
pub const MAD_TO_SIGMA: f64 = 1.4826;

/// The value in the middle, of an even number of values the larger of the two there (the upper median: always one of the
/// values); `None` of nothing.
pub fn upper_median(values: &mut [f64]) -> Option<f64> {
    let middle = values.len() / 2;
    (middle < values.len()).then(|| *values.select_nth_unstable_by(middle, f64::total_cmp).1)
}

/// The value in the middle, of an even number of values the mean of the two there; `None` of nothing.
pub fn median(values: &mut [f64]) -> Option<f64> {
    quantile(values, 0.5)
}

/// The value below which a `share` (0 to 1) of the values lies, linear between the order statistics at `share (n - 1)`;
/// `None` of nothing. Source: definition 7 of Hyndman and Fan, "Sample quantiles in statistical packages" (1996).
pub fn quantile(values: &mut [f64], share: f64) -> Option<f64> {
    let place = share.clamp(0.0, 1.0) * values.len().checked_sub(1)? as f64;
    let part = place.fract();
    let (_, low, above) = values.select_nth_unstable_by(place.floor() as usize, f64::total_cmp);
    let next = || above.iter().copied().min_by(f64::total_cmp).unwrap_or(*low);
    Some(if part == 0.0 { *low } else { *low * (1.0 - part) + next() * part })
}

/// Median absolute deviation from the median, which it leaves in place of the values; `None` of nothing. Of normal numbers
/// it is 1σ over [`MAD_TO_SIGMA`].
pub fn median_absolute_deviation(values: &mut [f64]) -> Option<f64> {
    let center = median(values)?;
    values.iter_mut().for_each(|value| *value = (*value - center).abs());
    median(values)
}
