//! Rotations about a fixed centre: a body that turns before a resting camera. `problem` states it for all pairs
//! together, `start` finds starts and their reversed rivals, `solve` refines rotations and the common centre with its
//! covariance.

mod problem;
mod solve;
mod start;

pub use problem::{CenterProblem, CenterSolution, CenteredPair};
pub use solve::{rotation_about_center, rotations_about_center};
