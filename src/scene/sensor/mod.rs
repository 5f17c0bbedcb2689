//! Settings of a camera's detector: exposure, shutter, vignetting, point spread, noise, read-out.

mod config;
mod exposure;
mod fixed_pattern;
mod shutter;
mod vignetting;

pub use config::SensorConfig;
pub use exposure::Exposure;
pub use fixed_pattern::FixedPatternConfig;
pub use shutter::ShutterConfig;
pub use vignetting::VignettingConfig;
