//! What a COLMAP model holds, in our conventions.

use crate::geometry::Camera;
use nalgebra::{Isometry3, Vector2, Vector3};

/// Cameras, posed images and points.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ColmapModel {
    /// The cameras; COLMAP's number is the place here plus 1.
    pub cameras: Vec<Camera>,
    /// The images; COLMAP's number is the place here plus 1.
    pub images: Vec<ColmapImage>,
    /// The points.
    pub points: Vec<ColmapPoint>,
}

/// A posed image.
#[derive(Debug, Clone, PartialEq)]
pub struct ColmapImage {
    /// Place of its camera in [`ColmapModel::cameras`].
    pub camera: usize,
    /// File name relative to the folder of images, without spaces.
    pub name: String,
    /// Pose of the camera in the reference frame, m.
    pub reference_from_camera: Isometry3<f64>,
    /// Pixels (ours) of points, each with the point's number.
    pub observations: Vec<(Vector2<f64>, u64)>,
}

/// A point in space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColmapPoint {
    /// Its number.
    pub id: u64,
    /// Position in the reference frame, m.
    pub position_m: Vector3<f64>,
}
