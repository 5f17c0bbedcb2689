//! ORB descriptors (Rublee et al. 2011) at given corners, on one scale.

use super::descriptor::{Descriptor, DescriptorNorm, EDGE_PX, MatchLimits, Orientation, key_points};
use super::descriptor_config::DescriptorConfig;
use super::descriptor_set::DescriptorSet;
use crate::vision::error::VisionError;
use crate::vision::features::Feature;
use crate::vision::opencv_bridge::image_mat;
use image::GrayImage;
use opencv::core::{Mat, no_array};
use opencv::features2d::{ORB, ORB_ScoreType};
use opencv::prelude::*;

/// 256 bits that describe the neighbourhood of a feature; their distance is the number of bits that differ.
pub(super) struct Orb;

const PATCH_PX: i32 = 31;
const ROW_BYTES: usize = 32;

impl Descriptor for Orb {
    fn describe(
        &self,
        image: &GrayImage,
        features: &[Feature],
        orientation: Orientation,
        _: &DescriptorConfig,
    ) -> Result<DescriptorSet, VisionError> {
        if features.is_empty() {
            return Ok(DescriptorSet::new(ROW_BYTES));
        }
        described(image, features, orientation).map_err(VisionError::opencv("describe features"))
    }

    fn norm(&self) -> DescriptorNorm {
        DescriptorNorm::Hamming
    }

    fn limits(&self, config: &DescriptorConfig) -> MatchLimits {
        MatchLimits { max_ratio: config.max_ratio, max_distance: f64::from(config.max_distance_bits) }
    }
}

fn described(image: &GrayImage, features: &[Feature], orientation: Orientation) -> opencv::Result<DescriptorSet> {
    let mut key_points = key_points(image, features.iter().enumerate(), (orientation, f64::from(PATCH_PX), 0))?;
    let mut orb = ORB::create(features.len() as i32, 1.2, 1, EDGE_PX, 0, 2, ORB_ScoreType::HARRIS_SCORE, PATCH_PX, 20)?;
    let mut bits = Mat::default();
    orb.detect_and_compute(&image_mat(image)?, &no_array(), &mut key_points, &mut bits, true)?;
    DescriptorSet::from_opencv((&key_points, &bits), ROW_BYTES, |row: &[u8], bytes| {
        bytes.extend_from_slice(row);
        true
    })
}
