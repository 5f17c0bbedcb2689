//! Shooting: the motion from its start, fitted to every rotation at once. `initial` finds starts, `epochs` chooses
//! times, `shooting` is the fit through its stages, `fit` one damped least-squares problem of it, and `held` keeps
//! undetermined directions where they are. Called by `estimate`, and for its first arc by the real-time filter.

mod epochs;
mod fit;
mod held;
mod initial;
mod shooting;

pub use epochs::{seconds, shooting_epochs};
pub use shooting::{ShootingFit, shoot};
