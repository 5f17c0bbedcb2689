//! Harris corners (Harris and Stephens 1988), spread evenly and located to a fraction of a pixel.

use super::corner_peak::{Grid, Peak};
use super::evenly::spread_evenly;
use super::opencv_bridge::picture_mat;
use super::picture_noise::noise_sigma_dn;
use super::{DetectorConfig, VisionError};
use image::GrayImage;
use nalgebra::{Matrix2, Vector2};
use opencv::core::{BORDER_REFLECT_101, CV_32F, Mat, Size};
use opencv::imgproc::{corner_harris, gaussian_blur};
use opencv::prelude::*;

/// A corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Feature {
    /// Pixel (u, v).
    pub pixel_px: Vector2<f64>,
    /// Harris response (grey levels as fractions of 255).
    pub response: f64,
    /// Predicted 1σ of each coordinate in px: the root of half the covariance's trace.
    pub sigma_px: f64,
    /// Predicted covariance of the pixel in px², from the noise through the structure tensor, and from the change of the
    /// ground's looks between two pictures through the shape of the peak.
    pub covariance_px2: Matrix2<f64>,
}

impl Feature {
    fn new(grid: &Grid, peak: &Peak, config: &DetectorConfig) -> Self {
        let covariance_px2 = grid.covariance_px2(peak, config);
        Feature {
            pixel_px: peak.pixel_px,
            response: peak.response,
            sigma_px: (0.5 * covariance_px2.trace()).sqrt(),
            covariance_px2,
        }
    }
}

/// Finds at most `max_features` Harris corners of a picture, in order of response; where `mask` is given, only where it
/// is not zero.
///
/// The picture is smoothed before, and the response after its gathering; the corner is the peak of a quadratic through 3×3
/// responses. Blunt peaks are left out: what changes between two pictures moves a peak by its width squared.
///
/// # Errors
/// A mask of another size, or OpenCV's refusal.
pub fn detect_harris(
    picture: &GrayImage,
    mask: Option<&GrayImage>,
    config: &DetectorConfig,
) -> Result<Vec<Feature>, VisionError> {
    if let Some(mask) = mask.filter(|m| m.dimensions() != picture.dimensions()) {
        let ((mask_width_px, mask_height_px), (width_px, height_px)) = (mask.dimensions(), picture.dimensions());
        return Err(VisionError::MaskSize { mask_width_px, mask_height_px, width_px, height_px });
    }
    let (smooth, response) = responses(picture, config).map_err(VisionError::opencv("compute the Harris response"))?;
    let grid = Grid {
        width: picture.width() as usize,
        height: picture.height() as usize,
        smooth: smooth.data_typed().map_err(VisionError::opencv("read the smoothed picture"))?,
        response: response.data_typed().map_err(VisionError::opencv("read the Harris response"))?,
        noise_dn: noise_sigma_dn(picture),
    };
    let feature = |at: usize| {
        let peak = grid.peak(at).filter(|p| p.width_px() <= config.max_peak_width_px)?;
        Some(Feature::new(&grid, &peak, config)).filter(|f| f.sigma_px <= config.max_sigma_px)
    };
    let peaks = grid.maxima(mask, config);
    let size = (grid.width, grid.height);
    let chosen = spread_evenly(&peaks, size, config.max_features, config.min_distance_px, |at| feature(at).is_some());
    Ok(chosen.iter().filter_map(|(_, at)| feature(*at)).collect())
}

/// The smoothed picture (grey levels / 255) and its smoothed Harris response.
fn responses(picture: &GrayImage, config: &DetectorConfig) -> opencv::Result<(Mat, Mat)> {
    let bytes = picture_mat(picture)?;
    let (mut grey, mut smooth, mut sharp, mut response) =
        (Mat::default(), Mat::default(), Mat::default(), Mat::default());
    bytes.convert_to(&mut grey, CV_32F, 1.0 / 255.0, 0.0)?;
    let blur = |from: &Mat, to: &mut Mat, sigma_px: f64| {
        gaussian_blur(from, to, Size::new(0, 0), sigma_px, sigma_px, BORDER_REFLECT_101)
    };
    blur(&grey, &mut smooth, config.smoothing_sigma_px)?;
    corner_harris(&smooth, &mut sharp, config.block_px as i32, 3, config.harris_k, BORDER_REFLECT_101)?;
    blur(&sharp, &mut response, config.response_sigma_px)?;
    Ok((smooth, response))
}
