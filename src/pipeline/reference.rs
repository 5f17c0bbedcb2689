//! The types of a scenario and of settings to the reference of their keys.

use crate::report;

/// Every key of a scenario with its type, unit, default, range and meaning, in Markdown.
#[cfg(feature = "scene")]
pub fn scenario_reference() -> String {
    report::scenario_reference(&crate::scene::Scenario::schema())
}

/// Every setting of the commands that read no scenario, likewise.
#[cfg(any(feature = "vision", all(feature = "scene", feature = "report")))]
pub fn settings_reference() -> String {
    report::settings_reference(&super::command_settings())
}
