//! The settings of every command, for their reference.

#[cfg(all(feature = "scene", feature = "report"))]
use super::MonteCarloSettings;
#[cfg(feature = "vision")]
use super::{DemoSettings, LandSettings, TrackSettings, TumbleSettings};
use crate::report::CommandSettings;
use crate::settings::Settings;

/// The settings of every command of the build that has its own; `render`, `map` and `bench` have those of a scenario.
pub fn command_settings() -> Vec<CommandSettings> {
    vec![
        #[cfg(feature = "vision")]
        of::<TrackSettings>("track"),
        #[cfg(feature = "vision")]
        of::<LandSettings>("land"),
        #[cfg(feature = "vision")]
        of::<TumbleSettings>("tumble"),
        #[cfg(all(feature = "scene", feature = "report"))]
        of::<MonteCarloSettings>("montecarlo landing"),
        #[cfg(feature = "vision")]
        of::<DemoSettings>("demo"),
    ]
}

fn of<S: Settings>(command: &'static str) -> CommandSettings {
    CommandSettings {
        command,
        schema: schemars::schema_for!(S).to_value(),
        defaults: serde_json::to_value(S::default()).expect("settings are plain data"),
    }
}
