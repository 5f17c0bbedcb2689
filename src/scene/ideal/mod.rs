//! What perfect sensors would measure of a scene: inertial samples (`ideal_imu`), depth and the landmarks that it lets
//! see (`depth_image`), optical flow (`optical_flow`). Truth is written from these; simulated sensors add their errors
//! to them.

mod depth_image;
mod ideal_imu;
mod optical_flow;

pub use depth_image::{DepthImage, observe_landmarks};
pub use ideal_imu::{SensedMotion, ideal_samples};
pub use optical_flow::optical_flow;
