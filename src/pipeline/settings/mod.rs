//! The settings of each command: one type a command, made of those of its stages, with the command's own defaults.

#[cfg(feature = "vision")]
mod commands;
#[cfg(feature = "vision")]
mod input;
mod listed;
#[cfg(all(feature = "scene", feature = "report"))]
mod montecarlo;
mod record;

#[cfg(feature = "vision")]
pub use commands::{DemoSettings, LandInput, LandSettings, TrackSettings, TumbleSettings};
#[cfg(feature = "vision")]
pub use input::InputSettings;
pub use listed::command_settings;
#[cfg(all(feature = "scene", feature = "report"))]
pub use montecarlo::MonteCarloSettings;
pub(super) use record::write_settings;
