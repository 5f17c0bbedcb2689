//! Whose code does a step that both have.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Whose code does a step. Both find the same but for rounding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Implementation {
    /// OpenCV's.
    #[default]
    Opencv,
    /// Our own, fused into one pass over the data: faster.
    Fused,
}
