//! Inertial measurements: increments, biases, gaps, and the planet whose frame turns.

mod biases;
mod imu;
mod planet;

pub use biases::ImuBiases;
pub use imu::{GAP_FORCE_SIGMA_M_S2, GAP_RATE_SIGMA_RAD_S, ImuIncrement, ImuRecord, LONGEST_GAP_S};
pub use planet::Planet;
