//! The reference of a scenario's keys, made from the types.

mod scenario_keys;
mod text;

pub use scenario_keys::scenario_reference;
