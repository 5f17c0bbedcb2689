//! Errors of matches that are not independent: neighbours that err together (`cluster_robust`), and localisation errors
//! that vary smoothly over the image (`correlated_error` over the basis of `correlated_modes`, with `elimination` of
//! the unknowns), which make up most of a rotation's covariance on rendered ground.

mod cluster_robust;
mod correlated_error;
mod correlated_modes;
mod elimination;

pub use cluster_robust::{cells, covariance_of_rotation, sums_by_cell};
pub use correlated_error::{Size, White, refine};
pub use correlated_modes::COEFFICIENTS;
pub use elimination::spread;
