//! Descriptors of all features of a picture, of the kind that is asked for.

use super::config::{DescriptorKind, MatcherConfig};
use super::descriptor::{Descriptor, Orientation};
use super::matcher::{Described, IndexMatch, match_features, match_features_guided};
use super::orb::{OrbDescriptor, describe_orb};
use super::sift::{SiftDescriptor, describe_sift};
use crate::vision::error::VisionError;
use crate::vision::features::Feature;
use image::GrayImage;
use nalgebra::Vector2;

/// One descriptor a feature, where there is one.
pub enum Descriptions {
    Orb(Vec<Option<OrbDescriptor>>),
    Sift(Vec<Option<SiftDescriptor>>),
}

/// A predicted place in the second picture for a pixel of the first.
pub(super) type Predict<'a> = &'a dyn Fn(&Vector2<f64>) -> Option<Vector2<f64>>;

impl Descriptions {
    pub fn find(
        picture: &GrayImage,
        features: &[Feature],
        orientation: Orientation,
        config: &MatcherConfig,
    ) -> Result<Self, VisionError> {
        Ok(match config.descriptor {
            DescriptorKind::Orb => Descriptions::Orb(describe_orb(picture, features, orientation)?),
            DescriptorKind::Sift => {
                Descriptions::Sift(describe_sift(picture, features, orientation, config.sift.patch_px)?)
            }
        })
    }
}

/// Matches two pictures' features by descriptors of one kind: near to where they are predicted, or anywhere.
pub fn match_described(
    (from, from_descriptions): (&[Feature], &Descriptions),
    (to, to_descriptions): (&[Feature], &Descriptions),
    predict: Option<Predict>,
    config: &MatcherConfig,
) -> Vec<IndexMatch> {
    match (from_descriptions, to_descriptions) {
        (Descriptions::Orb(a), Descriptions::Orb(b)) => matched(described(from, a), described(to, b), predict, config),
        (Descriptions::Sift(a), Descriptions::Sift(b)) => {
            matched(described(from, a), described(to, b), predict, config)
        }
        _ => unreachable!("one configuration describes all pictures"),
    }
}

fn described<'a, D>(features: &'a [Feature], descriptors: &'a [Option<D>]) -> Described<'a, D> {
    Described { features, descriptors }
}

fn matched<D: Descriptor>(
    from: Described<D>,
    to: Described<D>,
    predict: Option<Predict>,
    config: &MatcherConfig,
) -> Vec<IndexMatch> {
    match predict {
        Some(predict) => match_features_guided(from, to, predict, config),
        None => match_features(from, to, config),
    }
}
