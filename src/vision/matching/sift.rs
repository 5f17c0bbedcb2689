//! SIFT descriptors (Lowe 2004) at given corners, on one scale.

use super::descriptor::{Descriptor, DescriptorNorm, EDGE_PX, MatchLimits, Orientation, key_points};
use super::descriptor_config::{DescriptorConfig, SiftConfig};
use super::descriptor_set::DescriptorSet;
use crate::vision::error::VisionError;
use crate::vision::features::Feature;
use crate::vision::opencv_bridge::image_mat;
use image::GrayImage;
use opencv::core::{Mat, no_array};
use opencv::features2d::SIFT;
use opencv::prelude::*;

/// 128 sums of gradients about a feature, eight directions in each of 4×4 cells; their distance is that of vectors whose
/// length is about 512. Features on a flat patch have none. It holds some 30 bytes a pixel of the image meanwhile.
pub(super) struct Sift;

const ROW_BYTES: usize = 128;
/// Sides of the 4×4 cells together, in sizes of a key point: OpenCV takes three halves of the size for a cell's side.
const SIZES_A_PATCH: f64 = 6.0;
/// Smoothing of OpenCV's first layer, 1σ in px; each further one is smoother by the third root of two.
const FIRST_LAYER_SIGMA_PX: f64 = 1.6;
const LAYERS_AN_OCTAVE: f64 = 3.0;
const LAST_LAYER: f64 = 5.0;

impl Descriptor for Sift {
    fn describe(
        &self,
        image: &GrayImage,
        features: &[Feature],
        orientation: Orientation,
        config: &DescriptorConfig,
    ) -> Result<DescriptorSet, VisionError> {
        let patch_px = config.sift.patch_px;
        SiftConfig::check_patch_px(patch_px).map_err(|e| e.under("matcher.sift"))?;
        described(image, features, orientation, patch_px).map_err(VisionError::opencv("describe features"))
    }

    fn norm(&self) -> DescriptorNorm {
        DescriptorNorm::Euclidean
    }

    fn limits(&self, config: &DescriptorConfig) -> MatchLimits {
        MatchLimits { max_ratio: config.sift.max_ratio, max_distance: config.sift.max_distance }
    }
}

fn described(
    image: &GrayImage,
    features: &[Feature],
    orientation: Orientation,
    patch_px: f64,
) -> opencv::Result<DescriptorSet> {
    let size_px = patch_px / SIZES_A_PATCH;
    let inside = features.iter().enumerate().filter(|(_, feature)| is_inside(image, feature));
    let mut key_points = key_points(image, inside, (orientation, size_px, layer(size_px) << 8))?;
    if key_points.is_empty() {
        return Ok(DescriptorSet::new(ROW_BYTES));
    }
    let mut sums = Mat::default();
    // Made with OpenCV's defaults alone: what else can be set differs between its versions.
    SIFT::create_def()?.detect_and_compute(&image_mat(image)?, &no_array(), &mut key_points, &mut sums, true)?;
    DescriptorSet::from_opencv((&key_points, &sums), ROW_BYTES, |row: &[f32], bytes| {
        // OpenCV gives whole numbers up to 255 already.
        bytes.extend(row.iter().map(|sum| *sum as u8));
        row.iter().any(|sum| *sum > 0.0)
    })
}

fn is_inside(image: &GrayImage, feature: &Feature) -> bool {
    let clear = |x: f64, side_px: u32| x >= f64::from(EDGE_PX) && x < f64::from(side_px) - f64::from(EDGE_PX);
    clear(feature.pixel_px.x, image.width()) && clear(feature.pixel_px.y, image.height())
}

/// The layer of the first octave whose smoothing goes best with a key point's size: half of it, as in Lowe's detector.
fn layer(size_px: f64) -> i32 {
    (LAYERS_AN_OCTAVE * (0.5 * size_px / FIRST_LAYER_SIGMA_PX).log2()).round().clamp(0.0, LAST_LAYER) as i32
}
