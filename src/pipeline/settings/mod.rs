//! The settings of each command: one type a command, made of those of its stages, with the command's own defaults.

mod commands;
mod input;
mod listed;
mod record;

pub use commands::{DemoSettings, LandInput, LandSettings, MonteCarloSettings, TrackSettings, TumbleSettings};
pub use input::InputSettings;
pub use listed::command_settings;
pub(super) use record::write_settings;
