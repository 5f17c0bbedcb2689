//! Errors of matches that are not independent: clusters, and localisation errors that vary smoothly over the image.

mod cluster_robust;
mod correlated_error;
mod correlated_modes;
mod elimination;

pub use cluster_robust::{cells, covariance_of_rotation, sums_by_cell};
pub use correlated_error::{Size, White, refine};
pub use correlated_modes::COEFFICIENTS;
pub use elimination::spread;
