//! A tumbling small body in front of a camera that does not turn: rigid-body motion, where the Sun and the camera
//! stand, and the images to take.

mod build;
mod config;
mod inertia;
mod phase;
mod placement;
mod rigid_body;

pub use build::TumblingScene;
pub use config::TumblingConfig;
pub use inertia::InertiaSource;
pub use phase::PhaseConfig;
pub use rigid_body::{RigidBody, Spin};
