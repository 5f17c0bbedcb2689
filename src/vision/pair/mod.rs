//! The rotation of an image pair: models, robust fit, two-fold ambiguities, covariance.

mod cheirality;
mod config;
mod correspondence;
mod covariance;
mod fixed_center;
mod hypotheses;
mod models;
mod motion;
mod normalized_match;
mod parallax_gate;
mod plane;
mod pure_rotation;
mod relative_rotation;
mod residual;
mod robust_fit;
mod solution;
mod usac;

pub use config::{FixedCenterConfig, RotationConfig};
pub use correspondence::MatchedPair;
pub use fixed_center::{CenterProblem, CenterSolution, CenteredPair, rotation_about_center, rotations_about_center};
pub use relative_rotation::relative_rotation;
pub use solution::{PairHints, PairSolution, PixelMatches};
