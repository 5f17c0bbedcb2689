//! The rotation of a picture pair: models, robust fit, two-fold ambiguities, covariance.

mod cheirality;
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
mod robust_fit;
mod usac;

pub use fixed_center::{CenterProblem, CenterSolution, CenteredPair, rotation_about_center, rotations_about_center};
pub use relative_rotation::{PairHints, PairSolution, PixelMatches, relative_rotation};
