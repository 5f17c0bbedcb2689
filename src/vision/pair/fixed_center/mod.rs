//! Rotations about a fixed centre: a body that turns before a resting camera.

mod problem;
mod solve;
mod start;

pub use problem::{CenterProblem, CenterSolution, CenteredPair};
pub use solve::{rotation_about_center, rotations_about_center};
