//! Settings of descriptors.

use crate::settings::{OutOfRange, limits};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Settings of all descriptors; each takes its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DescriptorConfig<'a> {
    /// ORB: the best distance must be below this fraction of the second best.
    pub max_ratio: f64,
    /// ORB: greatest Hamming distance of 256 bits.
    pub max_distance_bits: u32,
    /// SIFT's.
    pub sift: &'a SiftConfig,
}

/// Description by SIFT and matching of such descriptors.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SiftConfig {
    /// Side of the square patch that is described, px, 8 to 128 (default 21).
    pub patch_px: f64,
    /// The best distance must be below this fraction of the second best, above 0 to 1 (default 0.84).
    pub max_ratio: f64,
    /// Greatest distance of two descriptors, whose length is about 512, above 0 (default 280).
    pub max_distance: f64,
}

impl Default for SiftConfig {
    fn default() -> Self {
        SiftConfig { patch_px: 21.0, max_ratio: 0.84, max_distance: 280.0 }
    }
}

impl SiftConfig {
    /// Smaller patches have fewer pixels than a descriptor has sums, which OpenCV's memory does not hold; larger ones take a
    /// long time and tell no more.
    pub(super) fn check_patch_px(patch_px: f64) -> Result<(), OutOfRange> {
        limits::within("patch_px", patch_px, 8.0, 128.0)
    }

    /// Checks every range.
    ///
    /// # Errors
    /// Names the key.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        SiftConfig::check_patch_px(self.patch_px)?;
        limits::above_to("max_ratio", self.max_ratio, 0.0, 1.0)?;
        limits::positive("max_distance", self.max_distance)
    }
}
