//! Where the camera truly was, and how far what it saw.

use super::error::EvaluationError;
use crate::dataset::{CameraSensor, DatasetError, read_camera_sensor, read_depth_tiff, read_tum};
use nalgebra::{Isometry3, Point3, Vector2, Vector3};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// An image's true depth.
pub struct TrueDepth(image::ImageBuffer<image::Luma<f32>, Vec<f32>>);

impl TrueDepth {
    /// z-depth in m at a pixel, bilinear between pixel centres; `None` outside the image and beside the edge of
    /// what was hit.
    pub fn at(&self, pixel_px: &Vector2<f64>) -> Option<f64> {
        let (width, height) = self.0.dimensions();
        let inside = pixel_px.x >= 0.0
            && pixel_px.y >= 0.0
            && pixel_px.x <= f64::from(width - 1)
            && pixel_px.y <= f64::from(height - 1);
        if !inside {
            return None;
        }
        let (u, v) = (pixel_px.x.floor() as u32, pixel_px.y.floor() as u32);
        let (du, dv) = (pixel_px.x.fract(), pixel_px.y.fract());
        let depth = |i: u32, j: u32| f64::from(self.0[(i.min(width - 1), j.min(height - 1))].0[0]);
        let top = depth(u, v) * (1.0 - du) + depth(u + 1, v) * du;
        let bottom = depth(u, v + 1) * (1.0 - du) + depth(u + 1, v + 1) * du;
        let mixed = top * (1.0 - dv) + bottom * dv;
        mixed.is_finite().then_some(mixed)
    }
}

/// The true camera of a data set: how it is built, and its pose at every frame.
pub struct TrueCamera {
    /// Intrinsic parameters and mounting.
    pub sensor: CameraSensor,
    /// Pose of the camera in the reference frame (site or asteroid) by time in ns.
    poses: HashMap<i64, Isometry3<f64>>,
    depth_folder: PathBuf,
}

impl TrueCamera {
    /// Reads `cam0/sensor.yaml` and `truth/cam0.tum` of a data set.
    ///
    /// # Errors
    /// Names the file at fault.
    pub fn read(root: &Path) -> Result<Self, EvaluationError> {
        let sensor = read_camera_sensor(&root.join("cam0/sensor.yaml"))?;
        let poses = read_tum(&root.join("truth/cam0.tum"))?;
        let poses = poses.iter().map(|p| (p.t_ns, p.reference_from_moving)).collect();
        Ok(TrueCamera { sensor, poses, depth_folder: root.join("truth/depth/cam0") })
    }

    /// Pose of the camera in the reference frame at the time of a frame.
    pub fn reference_from_camera(&self, t_ns: i64) -> Option<Isometry3<f64>> {
        self.poses.get(&t_ns).copied()
    }

    /// Time of the first pose in ns.
    pub fn start_ns(&self) -> i64 {
        self.poses.keys().copied().min().expect("a trajectory that was read has poses")
    }

    /// Depth of a frame; `None` where the data set has none.
    ///
    /// # Errors
    /// Names a file that is there and cannot be read, or whose size is not the camera's.
    pub fn depth(&self, t_ns: i64) -> Result<Option<TrueDepth>, EvaluationError> {
        let path = self.depth_folder.join(format!("{t_ns}.tiff"));
        if !path.is_file() {
            return Ok(None);
        }
        let depth = read_depth_tiff(&path)?;
        let camera = &self.sensor.camera;
        if depth.dimensions() != (camera.width_px, camera.height_px) {
            return Err(DatasetError::WrongSize {
                path,
                found_width_px: depth.width(),
                found_height_px: depth.height(),
                width_px: camera.width_px,
                height_px: camera.height_px,
            }
            .into());
        }
        Ok(Some(TrueDepth(depth)))
    }

    /// The surface point (m, reference frame) that a pixel of a frame saw.
    pub fn surface_point(&self, t_ns: i64, pixel_px: &Vector2<f64>, depth: &TrueDepth) -> Option<Vector3<f64>> {
        let ideal = self.sensor.camera.normalize(pixel_px)?;
        let point_in_camera_m = Vector3::new(ideal.x, ideal.y, 1.0) * depth.at(pixel_px)?;
        Some((self.reference_from_camera(t_ns)? * Point3::from(point_in_camera_m)).coords)
    }

    /// The pixel of a surface point (m, reference frame) in a frame; `None` behind the camera.
    pub fn pixel_of(&self, t_ns: i64, point_in_reference_m: &Vector3<f64>) -> Option<Vector2<f64>> {
        let camera_from_reference = self.reference_from_camera(t_ns)?.inverse();
        self.sensor.camera.project(&(camera_from_reference * Point3::from(*point_in_reference_m)).coords)
    }
}
