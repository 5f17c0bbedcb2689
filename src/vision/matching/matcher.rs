//! Matching of descriptors: mutual best, ratio test (Lowe 2004), and a search radius where a prediction is given.

use super::cell_index::CellIndex;
use super::config::MatcherConfig;
use super::descriptor_set::DescriptorSet;
use super::fused_matcher;
use super::index_match::{Candidates, IndexMatch};
use super::opencv_matcher;
use crate::vision::error::VisionError;
use crate::vision::features::Feature;
use crate::vision::implementation::Implementation;
use nalgebra::Vector2;

/// Features of one image with their descriptors.
#[derive(Debug, Clone, Copy)]
pub struct Described<'a> {
    /// The features.
    pub features: &'a [Feature],
    /// Their descriptors.
    pub descriptors: &'a DescriptorSet,
}

/// A predicted place in the second image for a pixel of the first; `None` leaves the feature out.
pub type Predict<'a> = &'a dyn Fn(&Vector2<f64>) -> Option<Vector2<f64>>;

/// Matches two images' features anywhere in the image: each the other's best, both passing the ratio test. Both are
/// described by the descriptor that is asked for. In order of the first image's index.
///
/// # Errors
/// OpenCV's refusal.
pub fn match_features(from: Described, to: Described, config: &MatcherConfig) -> Result<Vec<IndexMatch>, VisionError> {
    matched((from.descriptors, to.descriptors), None, config)
}

/// As [`match_features`], with candidates only within the search radius of where `predict` puts a pixel of the first
/// image.
///
/// # Errors
/// OpenCV's refusal.
pub fn match_features_guided(
    from: Described,
    to: Described,
    predict: Predict,
    config: &MatcherConfig,
) -> Result<Vec<IndexMatch>, VisionError> {
    let candidates = candidates(from, to, predict, config.guided_radius_px);
    matched((from.descriptors, to.descriptors), Some(&candidates), config)
}

fn candidates(from: Described, to: Described, predict: Predict, radius_px: f64) -> Candidates {
    let pixels_px = |d: Described| -> Vec<Vector2<f64>> {
        d.descriptors.features().iter().map(|feature| d.features[*feature].pixel_px).collect()
    };
    let there_px = pixels_px(to);
    let index = CellIndex::new(there_px.iter(), radius_px);
    let near = |pixel_px: &Vector2<f64>| {
        let Some(predicted_px) = predict(pixel_px) else { return Vec::new() };
        let close = |row: &usize| (there_px[*row] - predicted_px).norm() <= radius_px;
        let mut rows: Vec<usize> = index.near(&predicted_px).filter(close).collect();
        rows.sort_unstable();
        rows
    };
    pixels_px(from).iter().map(near).collect()
}

fn matched(
    (from, to): (&DescriptorSet, &DescriptorSet),
    candidates: Option<&Candidates>,
    config: &MatcherConfig,
) -> Result<Vec<IndexMatch>, VisionError> {
    if from.is_empty() || to.is_empty() {
        return Ok(Vec::new());
    }
    let descriptor = config.descriptor.part();
    let (norm, limits) = (descriptor.norm(), descriptor.limits(&config.descriptors()));
    let rows = match config.implementation {
        Implementation::Fused => fused_matcher::matched((from, to), candidates, (norm, &limits)),
        Implementation::Opencv => None,
    };
    let rows = match rows {
        Some(rows) => rows,
        None => opencv_matcher::matched((from, to), candidates, (norm, &limits))
            .map_err(VisionError::opencv("match descriptors"))?,
    };
    let of_features = |m: IndexMatch| IndexMatch { from: from.features()[m.from], to: to.features()[m.to], ..m };
    Ok(rows.into_iter().map(of_features).collect())
}
