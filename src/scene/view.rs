//! What an image is taken of at one moment.

use nalgebra::{Isometry3, Unit, Vector3};

/// One image to take: where the camera is and where the Sun stands, in the reference frame (`site` for a descent,
/// `asteroid` for a small body).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Time in ns.
    pub t_ns: i64,
    /// Pose of the camera in the reference frame, m.
    pub reference_from_camera: Isometry3<f64>,
    /// Direction to the Sun in the reference frame.
    pub sun_in_reference: Unit<Vector3<f64>>,
    /// Half the angle that the Sun's disc spans, in rad; 0 is a point, which casts hard shadows.
    pub sun_angular_radius_rad: f64,
}
