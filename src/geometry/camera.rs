//! A central camera: focal lengths, principal point, distortion.

use super::distortion::Distortion;
use crate::settings::{OutOfRange, limits};
use nalgebra::{Matrix2x3, Unit, Vector2, Vector3};
use thiserror::Error;

/// Why a camera's parameters cannot be used.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum CameraError {
    /// A parameter outside its range.
    #[error("camera parameter {0}")]
    OutOfRange(#[from] OutOfRange),
    /// The distortion cannot be inverted at a corner of the image.
    #[error("the distortion cannot be inverted at pixel ({u_px}, {v_px}): check the coefficients or crop the picture")]
    NotInvertible {
        /// Column in px.
        u_px: f64,
        /// Row in px.
        v_px: f64,
    },
}

/// Intrinsic parameters. Pixel centres are at integers: the top-left pixel's centre is (0, 0).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Image width in px.
    pub width_px: u32,
    /// Image height in px.
    pub height_px: u32,
    /// Focal lengths (fu, fv) in px.
    pub focal_px: Vector2<f64>,
    /// Principal point (cu, cv) in px.
    pub center_px: Vector2<f64>,
    /// Lens distortion.
    pub distortion: Distortion,
}

impl Camera {
    /// Pinhole camera with square pixels, centred principal point and the given horizontal field of view.
    pub fn from_fov(width_px: u32, height_px: u32, fov_x_rad: f64) -> Self {
        let focal = 0.5 * f64::from(width_px) / (0.5 * fov_x_rad).tan();
        Camera {
            width_px,
            height_px,
            focal_px: Vector2::new(focal, focal),
            center_px: Vector2::new(0.5 * f64::from(width_px) - 0.5, 0.5 * f64::from(height_px) - 0.5),
            distortion: Distortion::None,
        }
    }

    /// Checks ranges, and that every corner can be undistorted.
    ///
    /// # Errors
    /// [`CameraError`] names the parameter or the corner.
    pub fn validate(&self) -> Result<(), CameraError> {
        limits::count_from("width", self.width_px as usize, 1)?;
        limits::count_from("height", self.height_px as usize, 1)?;
        limits::positive("fu", self.focal_px.x)?;
        limits::positive("fv", self.focal_px.y)?;
        limits::finite("cu", &[self.center_px.x])?;
        limits::finite("cv", &[self.center_px.y])?;
        for corner in self.corners_px() {
            if self.unproject(&corner).is_none_or(|bearing| !bearing.iter().all(|c| c.is_finite())) {
                return Err(CameraError::NotInvertible { u_px: corner.x, v_px: corner.y });
            }
        }
        Ok(())
    }

    /// Pixel of a point in camera axes (m); `None` behind the camera and where the lens model folds over (no pixel sees
    /// the point). The pixel may lie outside the image.
    pub fn project(&self, point_in_camera_m: &Vector3<f64>) -> Option<Vector2<f64>> {
        self.project_with_jacobian(point_in_camera_m).map(|(pixel, _)| pixel)
    }

    /// Pixel of a point in camera axes, and its derivative (2×3, px/m) by the point; `None` as for [`Camera::project`].
    pub fn project_with_jacobian(&self, point_in_camera_m: &Vector3<f64>) -> Option<(Vector2<f64>, Matrix2x3<f64>)> {
        let p = point_in_camera_m;
        if p.z.is_nan() || p.z <= 0.0 {
            return None;
        }
        let ideal = Vector2::new(p.x / p.z, p.y / p.z);
        let (distorted, by_ideal) = self.distortion.distort(&ideal);
        // Both eigenvalues of the (symmetric) derivative are positive as long as the image has not folded over: far
        // outside the field of view a barrel polynomial would bring points back into the image.
        if by_ideal.determinant() <= 0.0 || by_ideal.trace() <= 0.0 {
            return None;
        }
        let by_point = Matrix2x3::new(1.0, 0.0, -ideal.x, 0.0, 1.0, -ideal.y) / p.z;
        let focal = nalgebra::Matrix2::from_diagonal(&self.focal_px);
        Some((self.focal_px.component_mul(&distorted) + self.center_px, focal * by_ideal * by_point))
    }

    /// Ideal (undistorted) coordinates (x/z, y/z) of a pixel; `None` where the distortion cannot be inverted.
    pub fn normalize(&self, pixel_px: &Vector2<f64>) -> Option<Vector2<f64>> {
        self.distortion.undistort(&(pixel_px - self.center_px).component_div(&self.focal_px))
    }

    /// Unit bearing in camera axes of a pixel; `None` where the distortion cannot be inverted.
    pub fn unproject(&self, pixel_px: &Vector2<f64>) -> Option<Unit<Vector3<f64>>> {
        self.normalize(pixel_px).map(|n| Unit::new_normalize(Vector3::new(n.x, n.y, 1.0)))
    }

    /// Whether a pixel lies inside the image, at least `margin_px` from its edge.
    pub fn contains(&self, pixel_px: &Vector2<f64>, margin_px: f64) -> bool {
        let (w, h) = (f64::from(self.width_px) - 0.5, f64::from(self.height_px) - 0.5);
        let low = margin_px - 0.5;
        pixel_px.x >= low && pixel_px.y >= low && pixel_px.x <= w - margin_px && pixel_px.y <= h - margin_px
    }

    /// Width and height in px.
    pub fn size_px(&self) -> (u32, u32) {
        (self.width_px, self.height_px)
    }

    /// Mean focal length in px: one pixel is about `1 / mean_focal_px()` radians on the axis.
    pub fn mean_focal_px(&self) -> f64 {
        0.5 * (self.focal_px.x + self.focal_px.y)
    }

    fn corners_px(&self) -> [Vector2<f64>; 4] {
        let (w, h) = (f64::from(self.width_px) - 0.5, f64::from(self.height_px) - 0.5);
        [Vector2::new(-0.5, -0.5), Vector2::new(w, -0.5), Vector2::new(-0.5, h), Vector2::new(w, h)]
    }
}
