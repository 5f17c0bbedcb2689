//! The rotation of a image pair. `relative_rotation` is the recipe: pixels become normalised coordinates, `usac`
//! proposes an essential matrix and a homography, `hypotheses` ranks what each may mean, `robust_fit` refines it over
//! `models` and `plane`, `parallax_gate` and `cheirality` refuse the impossible, and `covariance` says how well it is
//! known. `solution` is what comes out. It sees matched pixels, never images.

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
