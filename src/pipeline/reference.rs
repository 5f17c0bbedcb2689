//! The types of a scenario and of settings to the reference of their keys.

use super::command_settings;
use crate::report;
use crate::scene::Scenario;

/// Every key of a scenario with its type, unit, default, range and meaning, in Markdown.
pub fn scenario_reference() -> String {
    report::scenario_reference(&Scenario::schema())
}

/// Every setting of the commands that read no scenario, likewise.
pub fn settings_reference() -> String {
    report::settings_reference(&command_settings())
}
