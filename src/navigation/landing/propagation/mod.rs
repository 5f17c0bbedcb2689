//! From one image to the next: `predict` moves the state by an inertial increment, `covariance` moves the errors in
//! place, block by block, and `image_rotation` compares or fuses the rotation that the images themselves tell. Called
//! once a image by `step`.

mod covariance;
mod image_rotation;
mod predict;

pub use image_rotation::{ImageRotation, RotationCheck, image_rotations};
pub use predict::predict;
