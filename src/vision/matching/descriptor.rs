//! What describes a feature's neighbourhood.

use super::descriptor_config::DescriptorConfig;
use super::descriptor_set::DescriptorSet;
use crate::vision::error::VisionError;
use crate::vision::features::Feature;
use image::GrayImage;
use nalgebra::Vector2;
use opencv::core::{KeyPoint, Point2f, Vector};

/// How a descriptor's pattern is turned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Orientation {
    /// Along the image's axes: the most distinctive, up to about 12° of roll between two images.
    Upright,
    /// Along the line from the corner to the centroid of the grey levels about it: for any roll.
    Centroid,
}

/// Features closer to the image's edge are not described, px.
pub(super) const EDGE_PX: i32 = 8;

/// What a match must keep to, in the descriptor's own distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MatchLimits {
    /// The best distance must be below this fraction of the second best.
    pub max_ratio: f64,
    /// Greatest distance.
    pub max_distance: f64,
}

/// How far two descriptors lie apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DescriptorNorm {
    /// The number of bits that differ.
    Hamming,
    /// The length of the vector between them, each byte a component.
    Euclidean,
}

/// Describes the neighbourhoods of features by rows of bytes. A new one is a file of its own and a line in the list of
/// [`DescriptorKind`](crate::vision::DescriptorKind).
pub trait Descriptor: Sync {
    /// One row a feature, in the same order; features too close to the edge have none.
    ///
    /// # Errors
    /// A setting out of range, or OpenCV's refusal.
    fn describe(
        &self,
        image: &GrayImage,
        features: &[Feature],
        orientation: Orientation,
        config: &DescriptorConfig,
    ) -> Result<DescriptorSet, VisionError>;

    /// How two rows are compared.
    fn norm(&self) -> DescriptorNorm;

    /// The limits that a configuration sets for this kind.
    fn limits(&self, config: &DescriptorConfig) -> MatchLimits;
}

/// Key points of features for OpenCV, each with the feature's number as its `class_id`.
pub(super) fn key_points<'a>(
    image: &GrayImage,
    features: impl Iterator<Item = (usize, &'a Feature)>,
    (orientation, size_px, octave): (Orientation, f64, i32),
) -> opencv::Result<Vector<KeyPoint>> {
    let mut key_points: Vector<KeyPoint> = Vector::with_capacity(features.size_hint().0);
    for (index, feature) in features {
        let angle_deg = match orientation {
            Orientation::Upright => 0.0,
            Orientation::Centroid => centroid_angle_deg(image, &feature.pixel_px),
        };
        let point = Point2f::new(feature.pixel_px.x as f32, feature.pixel_px.y as f32);
        key_points.push(KeyPoint::new_point(point, size_px as f32, angle_deg, 0.0, octave, index as i32)?);
    }
    Ok(key_points)
}

/// Direction of the centroid of the grey levels in a disc of 15 px, degrees from +u towards +v.
fn centroid_angle_deg(image: &GrayImage, pixel_px: &Vector2<f64>) -> f32 {
    const RADIUS: i32 = 15;
    let (u, v) = (pixel_px.x.round() as i32, pixel_px.y.round() as i32);
    let (width, height) = (image.width() as i32, image.height() as i32);
    let grey = image.as_raw();
    let (mut m10, mut m01) = (0i64, 0i64);
    for dv in -RADIUS..=RADIUS {
        for du in -RADIUS..=RADIUS {
            let (x, y) = (u + du, v + dv);
            if du * du + dv * dv <= RADIUS * RADIUS && x >= 0 && y >= 0 && x < width && y < height {
                let value = i64::from(grey[(y * width + x) as usize]);
                m10 += i64::from(du) * value;
                m01 += i64::from(dv) * value;
            }
        }
    }
    (m01 as f64).atan2(m10 as f64).to_degrees().rem_euclid(360.0) as f32
}
