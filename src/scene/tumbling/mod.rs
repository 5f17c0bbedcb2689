//! A tumbling small body in front of a camera that does not turn. `config` is its table; `rigid_body` and `inertia` its
//! motion; `placement` and `phase` where camera and Sun stand; `build` makes the scene with the images to take.

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
