//! Parameters of the front end.

use super::features::DetectorConfig;
use super::matching::MatcherConfig;
use super::noise_model::{DesignatedNoise, NoiseModel};
use super::pair::{FixedCenterConfig, RotationConfig};
use super::patch::KltConfig;
use crate::settings::{OutOfRange, limits};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How the rotation between two images is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FrontEndMode {
    /// Essential matrix or homography, whichever explains the matches: a camera over ground, or any scene.
    #[default]
    Auto,
    /// A body that turns about a centre at a fixed place in the camera's frame.
    FixedCenter,
}

/// The whole front end.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct FrontEndConfig {
    /// How rotations are found (default auto).
    pub mode: FrontEndMode,
    /// Harris detection.
    pub detector: DetectorConfig,
    /// Description and matching.
    pub matcher: MatcherConfig,
    /// Following of patches.
    pub klt: KltConfig,
    /// Rotation.
    pub rotation: RotationConfig,
    /// The fixed-centre model, used in that mode only.
    pub fixed_center: FixedCenterConfig,
    /// Spans, in frames, of the keyframe pairs solved besides the adjacent ones, 2 or more (default 2, 3, 4).
    pub keyframe_spans: Vec<usize>,
    /// Keyframe pairs further apart are left out, rad, above 0 (default 0.5236, 30°).
    pub keyframe_max_angle_rad: f64,
    /// How wrong the carried designated point is (default: the noise model's).
    pub designated: DesignatedNoise,
}

impl Default for FrontEndConfig {
    fn default() -> Self {
        FrontEndConfig {
            mode: FrontEndMode::default(),
            detector: DetectorConfig::default(),
            matcher: MatcherConfig::default(),
            klt: KltConfig::default(),
            rotation: RotationConfig::default(),
            fixed_center: FixedCenterConfig::default(),
            keyframe_spans: vec![2, 3, 4],
            keyframe_max_angle_rad: 30f64.to_radians(),
            designated: DesignatedNoise::default(),
        }
    }
}

impl FrontEndConfig {
    /// The same settings with every constant of a noise model that concerns them.
    pub fn with_noise_model(mut self, model: &NoiseModel) -> Self {
        self.detector.noise = model.corner;
        self.klt.noise = model.patch;
        self.rotation.noise = model.pair;
        self.fixed_center.noise = model.body;
        self.designated = model.designated;
        self
    }

    /// Checks every range.
    ///
    /// # Errors
    /// Names the key.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        self.detector.validate().map_err(|e| e.under("detector"))?;
        self.matcher.validate().map_err(|e| e.under("matcher"))?;
        self.klt.validate().map_err(|e| e.under("klt"))?;
        self.rotation.validate().map_err(|e| e.under("rotation"))?;
        self.fixed_center.validate().map_err(|e| e.under("fixed_center"))?;
        self.designated.validate().map_err(|e| e.under("designated"))?;
        self.keyframe_spans.iter().try_for_each(|span| limits::count_from("keyframe_spans", *span, 2))?;
        limits::positive("keyframe_max_angle_rad", self.keyframe_max_angle_rad)
    }
}
