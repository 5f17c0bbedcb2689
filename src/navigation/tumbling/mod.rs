//! Attitude, spin and inertia ratios of a small body that turns freely, from rotations between pictures.
mod dynamics;
mod inertia;
mod lie;
mod state;
mod trajectory;

pub use dynamics::FreeBody;
pub use inertia::{INERTIA_NAMES, InertiaRatios};
pub use lie::lie_derivatives;
pub use state::SpinState;
pub use trajectory::{Sensitivity, TrajectoryPoint, propagate};
