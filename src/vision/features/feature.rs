//! A feature of an image.

use super::config::DetectorConfig;
use super::subpixel_peak::{Grid, Peak};
use nalgebra::{Matrix2, Vector2};

/// A corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Feature {
    /// Pixel (u, v).
    pub pixel_px: Vector2<f64>,
    /// Response of the detector (grey levels as fractions of 255).
    pub response: f64,
    /// Predicted 1σ of each coordinate in px: the root of half the covariance's trace.
    pub sigma_px: f64,
    /// Predicted covariance of the pixel in px², from the noise through the structure tensor, and from the change of the
    /// ground's looks between two images through the shape of the peak.
    pub covariance_px2: Matrix2<f64>,
}

impl Feature {
    pub(super) fn new(grid: &Grid, peak: &Peak, config: &DetectorConfig) -> Self {
        let covariance_px2 = grid.covariance_px2(peak, config);
        Feature {
            pixel_px: peak.pixel_px,
            response: peak.response,
            sigma_px: (0.5 * covariance_px2.trace()).sqrt(),
            covariance_px2,
        }
    }
}
