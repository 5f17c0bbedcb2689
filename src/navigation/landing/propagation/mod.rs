//! From one image to the next: the state by inertial measurements, its covariance, rotations seen by images.

mod covariance;
mod image_rotation;
mod predict;

pub use image_rotation::{ImageRotation, RotationCheck, image_rotations};
pub use predict::predict;
