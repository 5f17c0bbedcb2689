//! Features at the peaks of a detector's response.

use super::config::DetectorConfig;
use super::corner_response::responses_by_opencv;
use super::even_spread::bucketed;
use super::feature::Feature;
use super::image_noise::noise_sigma_dn;
use super::local_maxima::{Peaks, fused_maxima, maxima_by_opencv};
use super::subpixel_peak::Grid;
use crate::vision::error::VisionError;
use crate::vision::implementation::Implementation;
use image::GrayImage;
use opencv::prelude::*;

/// Finds at most `max_features` features of an image with the detector that is asked for, in order of response; where
/// `mask` is given, only where it is not zero.
///
/// A feature lies at the peak of a quadratic through 3×3 responses. Blunt peaks are left out: what changes between two
/// images moves a peak by its width squared.
///
/// # Errors
/// A mask of another size, or OpenCV's refusal.
pub fn detect_features(
    image: &GrayImage,
    mask: Option<&GrayImage>,
    config: &DetectorConfig,
) -> Result<Vec<Feature>, VisionError> {
    if let Some(mask) = mask.filter(|m| m.dimensions() != image.dimensions()) {
        let ((mask_width_px, mask_height_px), (width_px, height_px)) = (mask.dimensions(), image.dimensions());
        return Err(VisionError::MaskSize { mask_width_px, mask_height_px, width_px, height_px });
    }
    found(image, mask, config).map_err(VisionError::opencv("find features"))
}

fn found(image: &GrayImage, mask: Option<&GrayImage>, config: &DetectorConfig) -> opencv::Result<Vec<Feature>> {
    let (width, height) = (image.width() as usize, image.height() as usize);
    // The structure tensor is gathered over the whole block, and its slopes reach a pixel further.
    let border_px = config.border_px.max(config.block_px / 2 + 1) as usize;
    if width.min(height) <= 2 * border_px {
        return Ok(Vec::new());
    }
    let (detector, response) = (config.kind.part(), config.response());
    let model = detector.peaks();
    let least_ratio = config.min_response_ratio.powf(model.share()) as f32;
    let peaks = Peaks { border_px, least_ratio, mask };
    let fused = detector.fused().filter(|_| config.implementation == Implementation::Fused);
    let (responses, maxima) = match fused {
        Some(fused) => {
            let responses = fused(image, &response)?;
            let maxima = fused_maxima(&responses.response, &peaks)?;
            (responses, maxima)
        }
        None => {
            let responses = responses_by_opencv(detector, image, &response)?;
            let maxima = maxima_by_opencv(&responses.response, &peaks)?;
            (responses, maxima)
        }
    };
    let (smooth, response) = (responses.smooth.data_typed()?, responses.response.data_typed()?);
    let grid = Grid { width, smooth, response, noise_dn: noise_sigma_dn(image), model: &model };
    let feature = |at: usize| {
        let peak = grid.peak(at).filter(|p| p.width_px() <= config.max_peak_width_px)?;
        Some(Feature::new(&grid, &peak, config)).filter(|f| f.sigma_px <= config.max_sigma_px)
    };
    let chosen = bucketed(&maxima, (width, height), config.max_features, config.min_distance_px, feature);
    responses.put_back();
    Ok(chosen)
}
