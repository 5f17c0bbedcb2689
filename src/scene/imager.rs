//! What takes a picture.

use super::SensorConfig;
use crate::geometry::Camera;

/// A camera with its detector.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Imager {
    /// Intrinsic parameters.
    pub camera: Camera,
    /// The detector.
    pub detector: SensorConfig,
}
