//! Range checks of settings, each naming the key at fault.

use crate::scene::SceneError;

/// The value is a finite number above 0.
pub fn positive(key: &str, value: f64) -> Result<(), SceneError> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(SceneError::out_of_range(key, value, "it must be a positive number"))
}

/// The value lies in the closed interval.
pub fn within(key: &str, value: f64, low: f64, high: f64) -> Result<(), SceneError> {
    if (low..=high).contains(&value) {
        return Ok(());
    }
    Err(SceneError::out_of_range(key, value, format!("it must be a number from {low} to {high}")))
}

/// Every component is a finite number.
pub fn finite(key: &str, values: &[f64]) -> Result<(), SceneError> {
    match values.iter().find(|v| !v.is_finite()) {
        None => Ok(()),
        Some(value) => Err(SceneError::out_of_range(key, value, "every component must be a finite number")),
    }
}

/// The count lies in the closed interval.
pub fn count(key: &str, value: usize, low: usize, high: usize) -> Result<(), SceneError> {
    if (low..=high).contains(&value) {
        return Ok(());
    }
    Err(SceneError::out_of_range(key, value, format!("it must be a whole number from {low} to {high}")))
}

/// The quaternion w, x, y, z has the norm 1.
pub fn unit_quaternion(key: &str, wxyz: &[f64; 4]) -> Result<(), SceneError> {
    finite(key, wxyz)?;
    let norm = wxyz.iter().map(|v| v * v).sum::<f64>().sqrt();
    within(key, norm, 0.999, 1.001).map_err(|_| SceneError::out_of_range(key, norm, "its norm must be 1"))
}
