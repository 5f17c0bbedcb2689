//! Settings of a pair's rotation.

use crate::settings::{OutOfRange, limits};
use crate::vision::noise_model::{BodyNoise, PairNoise};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Rotation between two images.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RotationConfig {
    /// Inlier threshold of the first robust estimate, px, above 0 (default 1.5).
    pub threshold_px: f64,
    /// Nominal 1σ of a pixel where none is given, px, above 0 (default 0.3). The fit estimates its own scale from it.
    pub sigma_px: f64,
    /// Fewest matches to try, and fewest inliers to accept, 8 or more (default 20).
    pub min_matches: usize,
    /// Least fraction of the matches that must agree, 0 to 1 (default 0.3).
    pub min_inlier_ratio: f64,
    /// Greatest 1σ of the rotation about any axis that is still a determined rotation, rad, above 0 (default 0.02).
    pub max_sigma_rad: f64,
    /// Greatest rotation between two images, rad, above 0 (default 1.0); the twisted solution lies near π.
    pub max_angle_rad: f64,
    /// 1σ of a predicted rotation, rad, above 0 (default 0.005).
    pub prior_sigma_rad: f64,
    /// Errors that vary smoothly over the image (default: the noise model's).
    pub noise: PairNoise,
    /// Seed of the random samples, 0 to 2⁶³-1 (default 1).
    pub seed: u64,
}

impl Default for RotationConfig {
    fn default() -> Self {
        RotationConfig {
            threshold_px: 1.5,
            sigma_px: 0.3,
            min_matches: 20,
            min_inlier_ratio: 0.3,
            max_sigma_rad: 0.02,
            max_angle_rad: 1.0,
            prior_sigma_rad: 0.005,
            noise: PairNoise::default(),
            seed: 1,
        }
    }
}

/// The fixed-centre model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct FixedCenterConfig {
    /// 1σ of the first guess of the centre's direction (the centroid of the bright silhouette), rad, above 0
    /// (default 0.05).
    pub center_sigma_rad: f64,
    /// Width of the band along the limb and the terminator where no feature is taken, px, 0 or more (default 8).
    pub limb_margin_px: u32,
    /// A rate this far from the running median is suspect, rad/s, above 0 (default 0.017453, 1°/s)…
    pub rate_gate_rad_s: f64,
    /// …or this fraction of the median, whichever is greater, above 0 (default 0.2).
    pub rate_gate_ratio: f64,
    /// Errors that vary smoothly over the image (default: the noise model's): the light moves over a body that turns.
    pub noise: BodyNoise,
    /// Whether a patch's stretch from image to image is refined by its own grey levels (default true): a body's surface
    /// turns away within a few matches, and patches that are askew err alike.
    pub stretch_patches: bool,
}

impl Default for FixedCenterConfig {
    fn default() -> Self {
        FixedCenterConfig {
            center_sigma_rad: 0.05,
            limb_margin_px: 8,
            rate_gate_rad_s: 1f64.to_radians(),
            rate_gate_ratio: 0.2,
            noise: BodyNoise::default(),
            stretch_patches: true,
        }
    }
}

impl RotationConfig {
    /// Checks every range.
    ///
    /// # Errors
    /// Names the key.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::positive("threshold_px", self.threshold_px)?;
        limits::positive("sigma_px", self.sigma_px)?;
        limits::count_from("min_matches", self.min_matches, 8)?;
        limits::within("min_inlier_ratio", self.min_inlier_ratio, 0.0, 1.0)?;
        limits::positive("max_sigma_rad", self.max_sigma_rad)?;
        limits::positive("max_angle_rad", self.max_angle_rad)?;
        limits::positive("prior_sigma_rad", self.prior_sigma_rad)?;
        self.noise.validate().map_err(|e| e.under("noise"))?;
        limits::seed("seed", self.seed)
    }
}

impl FixedCenterConfig {
    /// Checks every range.
    ///
    /// # Errors
    /// Names the key.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::positive("center_sigma_rad", self.center_sigma_rad)?;
        limits::positive("rate_gate_rad_s", self.rate_gate_rad_s)?;
        limits::positive("rate_gate_ratio", self.rate_gate_ratio)?;
        self.noise.validate().map_err(|e| e.under("noise"))
    }
}
