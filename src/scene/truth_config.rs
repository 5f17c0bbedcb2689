//! Which truth a data set holds beside its pictures.

use serde::{Deserialize, Serialize};

/// Truth for each pixel that is written on request; depth and mask are always there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TruthConfig {
    /// Optical flow from each picture to the same camera's next one (default false).
    pub flow: bool,
}
