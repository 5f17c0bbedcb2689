//! A powered descent to a landing site. `config` is its table; `guidance` the path and `motion` the attitude along it;
//! `schedule` when images are taken; `imu_simulation` what is measured, `initial_error` what the lander believes at the
//! start; `build` makes the scene of them all, and refuses paths below the ground.

mod build;
mod camera_mount;
mod config;
mod ground;
mod guidance;
mod imu_simulation;
mod initial_error;
mod landmarks;
mod motion;
mod schedule;
mod sun;

pub use build::{DescentScene, check_above_ground};
pub use camera_mount::CameraMountConfig;
pub use config::DescentConfig;
pub use guidance::{GuidanceConfig, GuidanceProfile, PolynomialGuidance};
pub use imu_simulation::ImuConfig;
pub use initial_error::InitialErrorConfig;
pub use landmarks::landmarks_around_site;
pub use motion::DescentMotion;
pub use schedule::FrameSchedule;
pub use sun::SunConfig;
