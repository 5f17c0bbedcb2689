//! Settings of patch tracking.

use crate::settings::{OutOfRange, limits};
use crate::vision::noise_model::PatchNoise;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Following of patches.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct KltConfig {
    /// Half the patch's side, px, 2 or more (default 10: 21 px a side).
    pub half_px: u32,
    /// Sizes of the image that are searched, each half as large as the one before, 1 or more (default 3).
    pub levels: u32,
    /// Most steps on each size, 1 or more (default 20).
    pub max_iterations: u32,
    /// Greatest way from where a size's search begins, in px of that size, above 0 (default 4).
    pub max_off_px: f64,
    /// Patches that are less alike do not match, 0 to 1 (default 0.8).
    pub min_correlation: f64,
    /// A point followed there and back must end this near to where it began, px, above 0 (default 0.5).
    pub max_return_px: f64,
    /// Whether points whose corners are not found again are followed by their patches (default true); about a fixed centre
    /// they are not.
    pub follow_lost: bool,
    /// How wrong aligned patches are (default: the noise model's).
    pub noise: PatchNoise,
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
            noise: PatchNoise::default(),
        }
    }
}

impl KltConfig {
    /// Checks every range.
    ///
    /// # Errors
    /// Names the key.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::count_from("half_px", self.half_px as usize, 2)?;
        limits::count_from("levels", self.levels as usize, 1)?;
        limits::count_from("max_iterations", self.max_iterations as usize, 1)?;
        limits::positive("max_off_px", self.max_off_px)?;
        limits::within("min_correlation", self.min_correlation, 0.0, 1.0)?;
        limits::positive("max_return_px", self.max_return_px)?;
        self.noise.validate().map_err(|e| e.under("noise"))
    }
}
