//! The scenario: `file` is the TOML file as it stands, with overrides and unknown keys refused; `scenario` the same
//! with every default filled in; `mission` what happens and the scene that it builds; `render_config` and
//! `truth_config` two of its tables. Begin with `scenario`.

mod file;
mod mission;
mod render_config;
mod scenario;
mod truth_config;

pub use mission::{Mission, Scene};
pub use render_config::RenderConfig;
pub use scenario::Scenario;
pub use truth_config::TruthConfig;
