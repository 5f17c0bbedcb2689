//! Where a filter expects the camera, so that a map need only be searched there.

use nalgebra::Isometry3;

/// Where the camera is thought to be when an image is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PredictedCamera {
    /// Predicted pose: camera axes from the site frame, m.
    pub camera_from_site: Isometry3<f64>,
    /// 1σ of the camera's position, m an axis.
    pub sigma_position_m: f64,
    /// 1σ of the camera's attitude, rad an axis.
    pub sigma_attitude_rad: f64,
}
