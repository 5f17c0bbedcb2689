//! What perfect sensors would measure: depth, optical flow, inertial measurements.

mod depth_image;
mod ideal_imu;
mod optical_flow;

pub use depth_image::{DepthImage, observe_landmarks};
pub use ideal_imu::{SensedMotion, ideal_samples};
pub use optical_flow::optical_flow;
