//! Parameters of description and matching.

use super::descriptor_config::{DescriptorConfig, SiftConfig};
use super::descriptor_kind::DescriptorKind;
use crate::settings::{OutOfRange, limits};
use crate::vision::implementation::Implementation;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Description and matching.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct MatcherConfig {
    /// What describes a feature (default orb).
    pub descriptor: DescriptorKind,
    /// Whose code matches (default opencv); `fused` is faster.
    pub implementation: Implementation,
    /// ORB: the best distance must be below this fraction of the second best, above 0 to 1 (default 0.85).
    pub max_ratio: f64,
    /// ORB: greatest Hamming distance of 256 bits, 0 or more (default 64).
    pub max_distance_bits: u32,
    /// SIFT, used with that descriptor only.
    pub sift: SiftConfig,
    /// Search radius about the predicted pixel when the rotation is predicted, px, above 0 (default 60).
    pub guided_radius_px: f64,
}

impl Default for MatcherConfig {
    fn default() -> Self {
        MatcherConfig {
            descriptor: DescriptorKind::default(),
            implementation: Implementation::default(),
            max_ratio: 0.85,
            max_distance_bits: 64,
            sift: SiftConfig::default(),
            guided_radius_px: 60.0,
        }
    }
}

impl MatcherConfig {
    /// What descriptors need of it.
    pub(super) fn descriptors(&self) -> DescriptorConfig<'_> {
        let MatcherConfig { max_ratio, max_distance_bits, ref sift, .. } = *self;
        DescriptorConfig { max_ratio, max_distance_bits, sift }
    }

    /// Checks every range.
    ///
    /// # Errors
    /// Names the key.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::above_to("max_ratio", self.max_ratio, 0.0, 1.0)?;
        self.sift.validate().map_err(|e| e.under("sift"))?;
        limits::positive("guided_radius_px", self.guided_radius_px)
    }
}
