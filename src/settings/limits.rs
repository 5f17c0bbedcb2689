//! Range checks of settings, each naming the key at fault.

use super::OutOfRange;

/// The value is a finite number above 0.
///
/// # Errors
/// [`OutOfRange`] names the key, as for every check here.
pub fn positive(key: &str, value: f64) -> Result<(), OutOfRange> {
    check(key, value, value.is_finite() && value > 0.0, "it must be a positive number")
}

/// The value is a finite number above another.
///
/// # Errors
/// See [`positive`].
pub fn above(key: &str, value: f64, low: f64) -> Result<(), OutOfRange> {
    check(key, value, value.is_finite() && value > low, format!("it must be a number above {low}"))
}

/// The value is a finite number, and no less than another.
///
/// # Errors
/// See [`positive`].
pub fn at_least(key: &str, value: f64, low: f64) -> Result<(), OutOfRange> {
    check(key, value, value.is_finite() && value >= low, format!("it must be a number of {low} or more"))
}

/// The value lies in the closed interval.
///
/// # Errors
/// See [`positive`].
pub fn within(key: &str, value: f64, low: f64, high: f64) -> Result<(), OutOfRange> {
    check(key, value, (low..=high).contains(&value), format!("it must be a number from {low} to {high}"))
}

/// The value lies above the lower end and not above the upper one.
///
/// # Errors
/// See [`positive`].
pub fn above_to(key: &str, value: f64, low: f64, high: f64) -> Result<(), OutOfRange> {
    check(key, value, value > low && value <= high, format!("it must be a number above {low}, up to {high}"))
}

/// The value lies in the open interval.
///
/// # Errors
/// See [`positive`].
pub fn between(key: &str, value: f64, low: f64, high: f64) -> Result<(), OutOfRange> {
    check(key, value, value > low && value < high, format!("it must be a number between {low} and {high}"))
}

/// Every component is a finite number.
///
/// # Errors
/// See [`positive`].
pub fn finite(key: &str, values: &[f64]) -> Result<(), OutOfRange> {
    let cure = if values.len() == 1 { "it must be a finite number" } else { "every component must be a finite number" };
    values.iter().try_for_each(|value| check(key, *value, value.is_finite(), cure))
}

/// The count lies in the closed interval.
///
/// # Errors
/// See [`positive`].
pub fn count(key: &str, value: usize, low: usize, high: usize) -> Result<(), OutOfRange> {
    check(key, value, (low..=high).contains(&value), format!("it must be a whole number from {low} to {high}"))
}

/// The count is no less than another.
///
/// # Errors
/// See [`positive`].
pub fn count_from(key: &str, value: usize, low: usize) -> Result<(), OutOfRange> {
    check(key, value, value >= low, format!("it must be a whole number of {low} or more"))
}

/// The seed can be written to a file.
///
/// # Errors
/// See [`positive`].
pub fn seed(key: &str, value: u64) -> Result<(), OutOfRange> {
    check(key, value, i64::try_from(value).is_ok(), "it must be below 9223372036854775808")
}

/// The quaternion w, x, y, z has the norm 1.
///
/// # Errors
/// See [`positive`].
pub fn unit_quaternion(key: &str, wxyz: &[f64; 4]) -> Result<(), OutOfRange> {
    finite(key, wxyz)?;
    let norm = wxyz.iter().map(|v| v * v).sum::<f64>().sqrt();
    check(key, norm, (0.999..=1.001).contains(&norm), "its norm must be 1")
}

fn check<V: std::fmt::Display>(
    key: &str,
    value: V,
    fine: bool,
    cure: impl std::fmt::Display,
) -> Result<(), OutOfRange> {
    if fine { Ok(()) } else { Err(OutOfRange::new(key, value, cure)) }
}
