//! Settings of patch tracking.

use serde::{Deserialize, Serialize};

/// Following of patches.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct KltConfig {
    /// Half the patch's side, px (default 10: 21 px a side).
    pub half_px: u32,
    /// Sizes of the picture that are searched, each half as large as the one before (default 3).
    pub levels: u32,
    /// Most steps on each size (default 20).
    pub max_iterations: u32,
    /// Greatest way from where a size's search begins, in px of that size (default 4).
    pub max_off_px: f64,
    /// Patches that are less alike do not match (default 0.8).
    pub min_correlation: f64,
    /// A point followed there and back must end this near to where it began, px (default 0.5).
    pub max_return_px: f64,
    /// Whether points whose corners are not found again are followed by their patches (default true); about a fixed centre
    /// they are not.
    pub follow_lost: bool,
}

impl Default for KltConfig {
    fn default() -> Self {
        KltConfig {
            half_px: 10,
            levels: 3,
            max_iterations: 20,
            max_off_px: 4.0,
            min_correlation: 0.8,
            max_return_px: 0.5,
            follow_lost: true,
        }
    }
}
