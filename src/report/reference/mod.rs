//! The reference of a scenario's keys and of the commands' settings, made from the types.

mod scenario_keys;
mod text;

pub use scenario_keys::{CommandSettings, scenario_reference, settings_reference};
