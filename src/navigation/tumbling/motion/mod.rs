//! Euler's motion of a free body. `inertia` writes the ratios without their scale, which images cannot tell; `state` is
//! attitude and rate; `dynamics` their derivative; `trajectory` integrates them with sensitivities to start and ratios.
//! It knows no measurement; every other wing of the mission stands on it.

mod dynamics;
mod inertia;
mod state;
mod trajectory;

pub use dynamics::FreeBody;
pub use inertia::{INERTIA_NAMES, InertiaRatios, InertiaShape, xi};
pub use state::SpinState;
pub use trajectory::{Sensitivity, TrajectoryPoint, propagate};
