//! From one picture to the next: the state by inertial measurements, its covariance, rotations seen by pictures.

mod covariance;
mod image_rotation;
mod predict;

pub use image_rotation::{ImageRotation, RotationCheck, image_rotations};
pub use predict::predict;
