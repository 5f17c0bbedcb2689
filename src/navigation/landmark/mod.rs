//! Which unknown landmark to observe: the ideal point on the ground by depth error (Li et al. 2023), by the classical
//! observability metrics, by covariance or at random; and the choice of a real feature near it.
//!
//! One enum, [`Selector`], gives every method the same interface. Everything is in the `site` frame (z up, the known
//! landmark at the origin); the plane z = 0 is the mean ground.

mod bearing;
mod choose;
mod golden;
mod lookahead;
mod metrics;
mod selector;
mod triangle;
mod viewpoint;

pub use bearing::{bearing_jacobian, bearing_matrix, projector_over_range};
pub use choose::{Candidate, choose};
pub use golden::golden_section;
pub use lookahead::{posterior_position_variance_m2, stacked_bearings};
pub use metrics::{Metric, metric, scaled_metric};
pub use selector::Selector;
pub use triangle::Triangle;
pub use viewpoint::{GroundPrior, Viewpoint};
