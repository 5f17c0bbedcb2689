//! The settings of every command, for their reference.

use super::{DemoSettings, LandSettings, MonteCarloSettings, TrackSettings, TumbleSettings};
use crate::report::CommandSettings;
use crate::settings::Settings;

/// The settings of every command that has its own; `render`, `map` and `bench` have those of a scenario.
pub fn command_settings() -> Vec<CommandSettings> {
    vec![
        of::<TrackSettings>("track"),
        of::<LandSettings>("land"),
        of::<TumbleSettings>("tumble"),
        of::<MonteCarloSettings>("montecarlo landing"),
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
