//! ORB descriptors (Rublee et al. 2011) at given corners, on one scale.

use super::opencv_bridge::picture_mat;
use super::{Feature, VisionError};
use image::GrayImage;
use nalgebra::Vector2;
use opencv::core::{KeyPoint, Mat, Point2f, Vector, no_array};
use opencv::features2d::{ORB, ORB_ScoreType};
use opencv::prelude::*;

/// 256 bits that describe the neighbourhood of a feature.
pub type Descriptor = [u64; 4];

/// How a descriptor's pattern is turned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Orientation {
    /// Along the picture's axes: the most distinctive, up to about 12° of roll between two pictures.
    Upright,
    /// Along the line from the corner to the centroid of the grey levels about it: for any roll.
    Centroid,
}

const PATCH_PX: i32 = 31;
const EDGE_PX: i32 = 8;

/// One descriptor a feature, in the same order; features too close to the edge get `None`.
///
/// # Errors
/// OpenCV's refusal.
pub fn describe(
    picture: &GrayImage,
    features: &[Feature],
    orientation: Orientation,
) -> Result<Vec<Option<Descriptor>>, VisionError> {
    if features.is_empty() {
        return Ok(Vec::new());
    }
    describe_with_orb(picture, features, orientation).map_err(VisionError::opencv("describe features"))
}

fn describe_with_orb(
    picture: &GrayImage,
    features: &[Feature],
    orientation: Orientation,
) -> opencv::Result<Vec<Option<Descriptor>>> {
    let mut key_points: Vector<KeyPoint> = Vector::with_capacity(features.len());
    for (index, feature) in features.iter().enumerate() {
        let angle_deg = match orientation {
            Orientation::Upright => 0.0,
            Orientation::Centroid => centroid_angle_deg(picture, &feature.pixel_px),
        };
        let point = Point2f::new(feature.pixel_px.x as f32, feature.pixel_px.y as f32);
        key_points.push(KeyPoint::new_point(point, PATCH_PX as f32, angle_deg, 0.0, 0, index as i32)?);
    }
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

/// Direction of the centroid of the grey levels in a disc of 15 px, degrees from +u towards +v.
fn centroid_angle_deg(picture: &GrayImage, pixel_px: &Vector2<f64>) -> f32 {
    const RADIUS: i32 = 15;
    let (u, v) = (pixel_px.x.round() as i32, pixel_px.y.round() as i32);
    let (width, height) = (picture.width() as i32, picture.height() as i32);
    let grey = picture.as_raw();
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
