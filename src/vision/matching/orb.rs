//! ORB descriptors (Rublee et al. 2011) at given corners, on one scale.

use super::config::MatcherConfig;
use super::descriptor::{Descriptor, EDGE_PX, MatchLimits, Orientation, key_points};
use crate::vision::error::VisionError;
use crate::vision::features::Feature;
use crate::vision::opencv_bridge::picture_mat;
use image::GrayImage;
use opencv::core::{Mat, no_array};
use opencv::features2d::{ORB, ORB_ScoreType};
use opencv::prelude::*;

/// 256 bits that describe the neighbourhood of a feature; their distance is the number of bits that differ.
pub type OrbDescriptor = [u64; 4];

const PATCH_PX: i32 = 31;

impl Descriptor for OrbDescriptor {
    const WIDE: bool = false;

    #[inline(always)]
    fn difference(&self, other: &Self) -> u32 {
        self.iter().zip(other).map(|(x, y)| (x ^ y).count_ones()).sum()
    }

    #[inline(always)]
    fn distance(difference: u32) -> f64 {
        f64::from(difference)
    }

    fn limits(config: &MatcherConfig) -> MatchLimits {
        MatchLimits { max_ratio: config.max_ratio, max_distance: f64::from(config.max_distance_bits) }
    }
}

/// One ORB descriptor a feature, in the same order; features too close to the edge get `None`.
///
/// # Errors
/// OpenCV's refusal.
pub fn describe_orb(
    picture: &GrayImage,
    features: &[Feature],
    orientation: Orientation,
) -> Result<Vec<Option<OrbDescriptor>>, VisionError> {
    if features.is_empty() {
        return Ok(Vec::new());
    }
    described(picture, features, orientation).map_err(VisionError::opencv("describe features"))
}

fn described(
    picture: &GrayImage,
    features: &[Feature],
    orientation: Orientation,
) -> opencv::Result<Vec<Option<OrbDescriptor>>> {
    let mut key_points = key_points(picture, features.iter().enumerate(), (orientation, f64::from(PATCH_PX), 0))?;
    let mut orb = ORB::create(features.len() as i32, 1.2, 1, EDGE_PX, 0, 2, ORB_ScoreType::HARRIS_SCORE, PATCH_PX, 20)?;
    let mut bits = Mat::default();
    orb.detect_and_compute(&picture_mat(picture)?, &no_array(), &mut key_points, &mut bits, true)?;
    let mut descriptors = vec![None; features.len()];
    for (row, key_point) in key_points.iter().enumerate() {
        let bytes = bits.at_row::<u8>(row as i32)?;
        let word = |i: usize| u64::from_le_bytes(bytes[8 * i..8 * i + 8].try_into().expect("a row holds 32 bytes"));
        descriptors[key_point.class_id() as usize] = Some([word(0), word(1), word(2), word(3)]);
    }
    Ok(descriptors)
}
