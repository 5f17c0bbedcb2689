//! Rotations about a fixed centre: a body that turns before a resting camera.

mod solve;
mod start;

pub use solve::{CenterProblem, CenterSolution, CenteredPair, rotation_about_center, rotations_about_center};
