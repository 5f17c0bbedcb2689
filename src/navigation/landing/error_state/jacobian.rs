//! Jacobians of what is seen by the error state.

use nalgebra::{Matrix3, Vector3};

/// Derivative of a vector in the filter's axes (3×n): by the position, the attitude and one landmark.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelativeJacobian {
    /// By the error of the position.
    pub by_position: Matrix3<f64>,
    /// By the error of the attitude.
    pub by_attitude: Matrix3<f64>,
    /// By the error of the landmark that is looked at, if it is one of the state's.
    pub by_landmark: Matrix3<f64>,
}

/// A point in space fixed by a ray from the camera, with its derivatives in the filter's axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RayPoint {
    /// Position in the site frame, m.
    pub position_in_site_m: Vector3<f64>,
    /// By the error of the position.
    pub by_position: Matrix3<f64>,
    /// By the error of the attitude.
    pub by_attitude: Matrix3<f64>,
    /// By the bearing's error, a small vector across the bearing in lander axes.
    pub by_bearing: Matrix3<f64>,
    /// By the height of the ground, where the ray ends on it.
    pub by_height: Vector3<f64>,
}

/// Three components of an error state.
pub(super) fn part(error: &[f64], start: usize) -> Vector3<f64> {
    Vector3::from_column_slice(&error[start..start + 3])
}
