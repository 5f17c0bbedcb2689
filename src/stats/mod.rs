//! Seeded random streams, estimates with covariance, and χ² bounds for consistency tests.

mod chi_squared;
mod estimate;
mod stream;

pub use chi_squared::{ConsistencyBounds, normalized_error_squared};
pub use estimate::Estimate;
pub use stream::{random_stream, sub_stream};
