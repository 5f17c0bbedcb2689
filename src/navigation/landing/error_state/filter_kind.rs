//! The two forms of the filter.

use serde::{Deserialize, Serialize};

/// Coordinates of the error state.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "settings", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum FilterKind {
    /// Position, velocity and landmarks in lander axes, attitude in site axes: consistent.
    #[default]
    Hybrid,
    /// Position, velocity and landmarks in site axes, attitude in lander axes: the paper's, overconfident in yaw.
    Standard,
}
