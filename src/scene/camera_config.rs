//! The camera of a scenario.

use super::{SceneError, limits};
use crate::geometry::Camera;
use serde::{Deserialize, Serialize};

/// A pinhole camera with square pixels and its principal point in the middle. Pictures with lens distortion are not
/// drawn, so there is no key for it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CameraConfig {
    /// Picture width in px (default 1024).
    pub width_px: u32,
    /// Picture height in px (default 1024).
    pub height_px: u32,
    /// Horizontal field of view in degrees (default 90 for a descent, 30 for a tumbling body).
    pub fov_deg: f64,
}

impl Default for CameraConfig {
    fn default() -> Self {
        CameraConfig { width_px: 1024, height_px: 1024, fov_deg: 90.0 }
    }
}

impl CameraConfig {
    /// The camera's parameters.
    pub fn camera(&self) -> Camera {
        Camera::from_fov(self.width_px, self.height_px, self.fov_deg.to_radians())
    }

    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), SceneError> {
        limits::count("width_px", self.width_px as usize, 16, 16_384)?;
        limits::count("height_px", self.height_px as usize, 16, 16_384)?;
        limits::within("fov_deg", self.fov_deg, 0.01, 170.0)
    }
}
