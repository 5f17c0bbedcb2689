//! Shooting: the motion from its start, fitted to every rotation at once.

mod fit;
mod held;
mod initial;
mod shooting;

pub use shooting::{ShootingFit, shoot};
