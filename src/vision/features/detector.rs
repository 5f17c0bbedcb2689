//! What a detector is: a corner response, and what is known of its peaks.

use super::response_config::ResponseConfig;
use super::responses::Responses;
use image::GrayImage;
use opencv::core::Mat;

/// What is known of the peaks of a detector's response.
///
/// Responses grow with different powers of an image's slopes: Harris' with the fourth, an eigenvalue of the structure
/// tensor with the second. Of a lower power, peaks are flatter and change by less. Widths, least responses and changes are
/// those that the response would have at the fourth power, so that one setting serves all detectors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PeakModel {
    /// The power of the slopes that the response grows with.
    pub slope_power: f64,
    /// What changes between two images besides noise tilts the response (to the fourth power) about a peak by so many times
    /// what the noise model says of Harris' response.
    pub change_over_harris: f64,
    /// Noise moves a peak by so many times what the noise model says of Harris' response.
    pub noise_over_harris: f64,
}

impl PeakModel {
    /// The power over Harris' one.
    pub(super) fn share(&self) -> f64 {
        self.slope_power / 4.0
    }
}

/// Responds to corners. Smoothing, maxima, sub-pixel place, covariance and spread are common to all detectors.
///
/// A new one is a file of its own and a line in the list of [`DetectorKind`](crate::vision::DetectorKind).
pub trait Detector: Sync {
    /// What is known of the response's peaks.
    fn peaks(&self) -> PeakModel;

    /// The response to a smoothed image (grey levels over 255), both 32-bit floating point. A pixel's response depends on
    /// no more than half a block and a pixel about it.
    ///
    /// # Errors
    /// OpenCV's refusal.
    fn respond(&self, smooth: &Mat, config: &ResponseConfig, response: &mut Mat) -> opencv::Result<()>;

    /// Our own code for smoothed image and response at once, where there is any.
    fn fused(&self) -> Option<FusedResponse> {
        None
    }
}

/// Smoothed image and response in one pass.
pub type FusedResponse = fn(&GrayImage, &ResponseConfig) -> opencv::Result<Responses>;
