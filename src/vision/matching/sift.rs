//! SIFT descriptors (Lowe 2004) at given corners, on one scale.

use super::config::{MatcherConfig, SiftConfig};
use super::descriptor::{Descriptor, EDGE_PX, MatchLimits, Orientation, key_points};
use crate::vision::error::VisionError;
use crate::vision::features::Feature;
use crate::vision::opencv_bridge::picture_mat;
use image::GrayImage;
use opencv::core::{Mat, no_array};
use opencv::features2d::SIFT;
use opencv::prelude::*;

/// 128 sums of gradients about a feature, eight directions in each of 4×4 cells; their distance is that of vectors whose
/// length is about 512.
pub type SiftDescriptor = [u8; 128];

/// Sides of the 4×4 cells together, in sizes of a key point: OpenCV takes three halves of the size for a cell's side.
const SIZES_A_PATCH: f64 = 6.0;
/// Smoothing of OpenCV's first layer, 1σ in px; each further one is smoother by the third root of two.
const FIRST_LAYER_SIGMA_PX: f64 = 1.6;
const LAYERS_AN_OCTAVE: f64 = 3.0;
const LAST_LAYER: f64 = 5.0;

impl Descriptor for SiftDescriptor {
    const WIDE: bool = true;

    #[inline(always)]
    fn difference(&self, other: &Self) -> u32 {
        // Sixteen sums side by side, as the processor's vectors hold them. None can overflow: saying so leaves out the
        // checks of builds for development, which would keep it from using them.
        let mut sums = [0i32; 16];
        for block in 0..8 {
            for (lane, sum) in sums.iter_mut().enumerate() {
                let at = 16 * block + lane;
                let off = i16::from(self[at]).wrapping_sub(i16::from(other[at]));
                *sum = sum.wrapping_add(i32::from(off).wrapping_mul(i32::from(off)));
            }
        }
        sums.iter().fold(0i32, |all, sum| all.wrapping_add(*sum)) as u32
    }

    #[inline(always)]
    fn distance(difference: u32) -> f64 {
        f64::from(difference).sqrt()
    }

    fn limits(config: &MatcherConfig) -> MatchLimits {
        MatchLimits { max_ratio: config.sift.max_ratio, max_distance: config.sift.max_distance }
    }
}

/// One SIFT descriptor a feature, in the same order, of a square patch of that side (8 to 128 px); features too close to
/// the picture's edge and those on a flat patch get `None`. It holds some 30 bytes a pixel of the picture meanwhile.
///
/// # Errors
/// A patch of another size, or OpenCV's refusal.
pub fn describe_sift(
    picture: &GrayImage,
    features: &[Feature],
    orientation: Orientation,
    patch_px: f64,
) -> Result<Vec<Option<SiftDescriptor>>, VisionError> {
    SiftConfig::check_patch_px(patch_px).map_err(|e| e.under("matcher.sift"))?;
    described(picture, features, orientation, patch_px).map_err(VisionError::opencv("describe features"))
}

fn described(
    picture: &GrayImage,
    features: &[Feature],
    orientation: Orientation,
    patch_px: f64,
) -> opencv::Result<Vec<Option<SiftDescriptor>>> {
    let mut descriptors = vec![None; features.len()];
    let size_px = patch_px / SIZES_A_PATCH;
    let inside = features.iter().enumerate().filter(|(_, feature)| is_inside(picture, feature));
    let mut key_points = key_points(picture, inside, (orientation, size_px, layer(size_px) << 8))?;
    if key_points.is_empty() {
        return Ok(descriptors);
    }
    let mut sums = Mat::default();
    // Made with OpenCV's defaults alone: what else can be set differs between its versions.
    SIFT::create_def()?.detect_and_compute(&picture_mat(picture)?, &no_array(), &mut key_points, &mut sums, true)?;
    for (row, key_point) in key_points.iter().enumerate() {
        let row = sums.at_row::<f32>(row as i32)?;
        if row.iter().any(|sum| *sum > 0.0) {
            // OpenCV gives whole numbers up to 255 already.
            descriptors[key_point.class_id() as usize] = Some(std::array::from_fn(|i| row[i] as u8));
        }
    }
    Ok(descriptors)
}

fn is_inside(picture: &GrayImage, feature: &Feature) -> bool {
    let clear = |x: f64, side_px: u32| x >= f64::from(EDGE_PX) && x < f64::from(side_px) - f64::from(EDGE_PX);
    clear(feature.pixel_px.x, picture.width()) && clear(feature.pixel_px.y, picture.height())
}

/// The layer of the first octave whose smoothing goes best with a key point's size: half of it, as in Lowe's detector.
fn layer(size_px: f64) -> i32 {
    (LAYERS_AN_OCTAVE * (0.5 * size_px / FIRST_LAYER_SIGMA_PX).log2()).round().clamp(0.0, LAST_LAYER) as i32
}
