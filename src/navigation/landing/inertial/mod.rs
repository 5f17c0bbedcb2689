//! Inertial measurements between two images: `imu` sums samples to an increment with its covariance and bridges gaps,
//! `biases` are what it subtracts, and `planet` says how gravity and the turning frame act on what is left. No other
//! wing integrates samples.

mod biases;
mod imu;
mod planet;

pub use biases::ImuBiases;
pub use imu::{GAP_FORCE_SIGMA_M_S2, GAP_RATE_SIGMA_RAD_S, ImuIncrement, ImuRecord, LONGEST_GAP_S};
pub use planet::Planet;
