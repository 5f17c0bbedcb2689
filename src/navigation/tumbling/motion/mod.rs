//! Euler's motion of a free body: state, inertia ratios, dynamics, the trajectory with its sensitivities.

mod dynamics;
mod inertia;
mod state;
mod trajectory;

pub use dynamics::FreeBody;
pub use inertia::{INERTIA_NAMES, InertiaRatios, InertiaShape, xi};
pub use state::SpinState;
pub use trajectory::{Sensitivity, TrajectoryPoint, propagate};
