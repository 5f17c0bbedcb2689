//! Seeded random streams (`stream`: the same name and seed give the same numbers on every machine), estimates with
//! covariance (`estimate`), χ² bounds for consistency tests (`chi_squared`), robust statistics (`robust`), exact
//! symmetry (`symmetric`), and one damped least-squares loop for all fits (`least_squares`, `residuals`). It knows no
//! mission; every room but `geometry` and `settings` may use it.

mod chi_squared;
mod estimate;
mod least_squares;
mod residuals;
mod robust;
mod stream;
mod symmetric;

pub use chi_squared::{ConsistencyBounds, normalized_error_squared};
pub use estimate::Estimate;
pub use least_squares::{Damping, LeastSquares, LeastSquaresOptions, Minimum, NormalEquations, Steps, Stop, minimize};
pub use residuals::Residuals;
pub use robust::{
    MAD_TO_SIGMA, NORMAL_MEDIAN, NORMAL_MEDIAN_2D, SQUARED_NORMAL_MEDIAN_3D, median, median_absolute_deviation,
    quantile, upper_median,
};
pub use stream::{random_stream, sub_stream};
pub use symmetric::symmetric;
