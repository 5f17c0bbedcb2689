//! Several flexibly linked spacecraft that descend together to a site on a small body: guidance of their centre, the
//! motion of each against the others, gravity of a turning body, inertial measurements of each, and the images to take.
//!
//! The site frame turns with the body; its x axis points east, y north, z up. A node's camera looks along its -z axis,
//! camera axes `C = diag(1, -1, -1)` of the node's.

mod build;
mod config;
mod gravity;
mod guidance;
mod imu_simulation;
mod initial_error;
mod link;
mod node_motion;

pub use build::{AttachmentNode, AttachmentScene};
pub use config::AttachmentConfig;
pub use gravity::{BodyConfig, TurningBody};
pub use guidance::{ApolloGuidance, ApproachConfig};
pub use imu_simulation::NodeImuConfig;
pub use initial_error::NodeErrorConfig;
pub use link::{FlexConfig, Sinusoids};
pub use node_motion::NodeMotion;
