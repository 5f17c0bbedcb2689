//! Harris corners (Harris and Stephens 1988), spread evenly and located to a fraction of a pixel.

use super::config::DetectorConfig;
use super::even_spread::spread_evenly;
use super::feature::Feature;
use super::harris_response::responses;
use super::image_noise::noise_sigma_dn;
use super::local_maxima::local_maxima;
use super::subpixel_peak::Grid;
use crate::vision::error::VisionError;
use image::GrayImage;

/// Finds at most `max_features` Harris corners of a picture, in order of response; where `mask` is given, only where it
/// is not zero.
///
/// The picture is smoothed before, and the response after its gathering; the corner is the peak of a quadratic through 3×3
/// responses. Blunt peaks are left out: what changes between two pictures moves a peak by its width squared.
///
/// # Errors
/// A mask of another size.
pub fn detect_harris(
    picture: &GrayImage,
    mask: Option<&GrayImage>,
    config: &DetectorConfig,
) -> Result<Vec<Feature>, VisionError> {
    if let Some(mask) = mask.filter(|m| m.dimensions() != picture.dimensions()) {
        let ((mask_width_px, mask_height_px), (width_px, height_px)) = (mask.dimensions(), picture.dimensions());
        return Err(VisionError::MaskSize { mask_width_px, mask_height_px, width_px, height_px });
    }
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let found = responses(picture.as_raw(), (width, height), config);
    let grid = Grid { width, smooth: &found.smooth, response: &found.response, noise_dn: noise_sigma_dn(picture) };
    let feature = |at: usize| {
        let peak = grid.peak(at).filter(|p| p.width_px() <= config.max_peak_width_px)?;
        Some(Feature::new(&grid, &peak, config)).filter(|f| f.sigma_px <= config.max_sigma_px)
    };
    let limits = (config.border_px as usize, config.min_response_ratio as f32);
    let peaks = local_maxima((grid.response, width), limits, mask);
    let chosen = spread_evenly(&peaks, (width, height), config.max_features, config.min_distance_px, feature);
    found.put_back();
    Ok(chosen)
}
