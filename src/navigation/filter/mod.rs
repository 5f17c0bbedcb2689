//! What filters share and that knows no spacecraft: innovations, gating, corrections in Joseph's form, iterated
//! corrections, and a small extended Kalman filter on manifolds.
//!
//! Every function takes an estimate and returns a new one. A gated measurement is an outcome, not an error.

mod correction;
mod ekf;
mod gate;
mod innovation;

pub use correction::{Correction, correction, iterated_correction};
pub use ekf::{Measurement, correct, predict};
pub use gate::Gate;
pub use innovation::Innovation;
