//! Rotations, poses, camera models and numerical Jacobians. This room knows no spacecraft and no file, and every other
//! may use it. `so3` holds the exponential, the logarithm and the conventions of the error state; `camera` and
//! `distortion` map between bearings and pixels with derivatives; `jacobian` is the reference that analytic derivatives
//! are tested against.

mod camera;
mod distortion;
mod jacobian;
pub mod so3;

pub use camera::{Camera, CameraError};
pub use distortion::Distortion;
pub use jacobian::central_difference;
pub use so3::Manifold;
