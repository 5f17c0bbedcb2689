//! The reference of a scenario's keys and of the commands' settings, made from the types.

mod pages;
mod schema;
mod section;
mod text;

pub use pages::{CommandSettings, scenario_reference, settings_reference};
