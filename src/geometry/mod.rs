//! Rotations, poses, camera models and numerical Jacobians. This room knows no spacecraft and no file.

mod camera;
mod distortion;
mod jacobian;
pub mod so3;

pub use camera::{Camera, CameraError};
pub use distortion::Distortion;
pub use jacobian::central_difference;
pub use so3::Manifold;
