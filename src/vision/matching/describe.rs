//! Descriptors of the features of an image, by the descriptor that is asked for.

use super::config::MatcherConfig;
use super::descriptor::Orientation;
use super::descriptor_set::DescriptorSet;
use crate::vision::error::VisionError;
use crate::vision::features::Feature;
use image::GrayImage;

/// Describes features of an image with the descriptor that is asked for.
///
/// # Errors
/// A setting out of range, or OpenCV's refusal.
pub fn describe_features(
    image: &GrayImage,
    features: &[Feature],
    orientation: Orientation,
    config: &MatcherConfig,
) -> Result<DescriptorSet, VisionError> {
    config.descriptor.part().describe(image, features, orientation, &config.descriptors())
}
