//! The scenario: one TOML file, its tables, and the mission that it builds.

mod file;
mod mission;
mod render_config;
mod scenario;
mod truth_config;

pub use mission::{Mission, Scene};
pub use render_config::RenderConfig;
pub use scenario::Scenario;
pub use truth_config::TruthConfig;
