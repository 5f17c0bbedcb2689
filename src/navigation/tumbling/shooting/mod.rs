//! Shooting: the motion from its start, fitted to every rotation at once.

mod epochs;
mod fit;
mod held;
mod initial;
mod shooting;

pub use epochs::{seconds, shooting_epochs};
pub use shooting::{ShootingFit, shoot};
