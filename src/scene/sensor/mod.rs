//! Settings of a camera's detector, in the order of the physics: `exposure`, `shutter`, `vignetting`, `fixed_pattern`,
//! and all together in `config`. The detector itself stands in `render/sensor`.

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
