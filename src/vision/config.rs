//! Parameters of the front end.

use super::error::VisionError;
use super::features::DetectorConfig;
use super::matching::{MatcherConfig, PATCH_CURE, PATCH_RANGE_PX};
use super::pair::{FixedCenterConfig, RotationConfig};
use super::patch::KltConfig;
use serde::{Deserialize, Serialize};

/// How the rotation between two pictures is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FrontEndMode {
    /// Essential matrix or homography, whichever explains the matches: a camera over ground, or any scene.
    #[default]
    Auto,
    /// A body that turns about a centre at a fixed place in the camera's frame.
    FixedCenter,
}

/// The whole front end.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
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
    /// Spans, in frames, of the keyframe pairs solved besides the adjacent ones (default 2, 3, 4).
    pub keyframe_spans: Vec<usize>,
    /// Keyframe pairs further apart are left out, rad (default 30°).
    pub keyframe_max_angle_rad: f64,
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
        }
    }
}

impl FrontEndConfig {
    /// Checks ranges.
    ///
    /// # Errors
    /// [`VisionError::OutOfRange`] names the key.
    pub fn validate(&self) -> Result<(), VisionError> {
        let (d, m, k) = (&self.detector, &self.matcher, &self.klt);
        let (r, c) = (&self.rotation, &self.fixed_center);
        let positive = [
            ("detector.max_features", d.max_features as f64),
            ("detector.smoothing_sigma_px", d.smoothing_sigma_px),
            ("detector.response_sigma_px", d.response_sigma_px),
            ("detector.max_peak_width_px", d.max_peak_width_px),
            ("detector.harris_k", d.harris_k),
            ("detector.min_response_ratio", d.min_response_ratio),
            ("detector.min_distance_px", d.min_distance_px),
            ("detector.max_sigma_px", d.max_sigma_px),
            ("matcher.max_ratio", m.max_ratio),
            ("matcher.sift.max_ratio", m.sift.max_ratio),
            ("matcher.sift.max_distance", m.sift.max_distance),
            ("matcher.guided_radius_px", m.guided_radius_px),
            ("klt.max_off_px", k.max_off_px),
            ("klt.max_return_px", k.max_return_px),
            ("rotation.threshold_px", r.threshold_px),
            ("rotation.sigma_px", r.sigma_px),
            ("rotation.max_sigma_rad", r.max_sigma_rad),
            ("rotation.max_angle_rad", r.max_angle_rad),
            ("rotation.prior_sigma_rad", r.prior_sigma_rad),
            ("fixed_center.center_sigma_rad", c.center_sigma_rad),
            ("fixed_center.rate_gate_rad_s", c.rate_gate_rad_s),
            ("fixed_center.rate_gate_ratio", c.rate_gate_ratio),
            ("keyframe_max_angle_rad", self.keyframe_max_angle_rad),
        ];
        for (name, value) in positive {
            if !(value > 0.0 && value.is_finite()) {
                return Err(VisionError::OutOfRange { name, value, cure: "it must be a positive number" });
            }
        }
        let at_least = [
            ("detector.block_px", f64::from(d.block_px), 3.0, "it must be an odd number of 3 or more"),
            ("detector.border_px", f64::from(d.border_px), 4.0, "it must be 4 or more"),
            ("klt.half_px", f64::from(k.half_px), 2.0, "it must be 2 or more"),
            ("klt.levels", f64::from(k.levels), 1.0, "it must be 1 or more"),
            ("klt.max_iterations", f64::from(k.max_iterations), 1.0, "it must be 1 or more"),
            ("rotation.min_matches", r.min_matches as f64, 8.0, "it must be 8 or more"),
        ];
        for (name, value, least, cure) in at_least {
            if value < least {
                return Err(VisionError::OutOfRange { name, value, cure });
            }
        }
        if !PATCH_RANGE_PX.contains(&m.sift.patch_px) {
            let value = m.sift.patch_px;
            return Err(VisionError::OutOfRange { name: "matcher.sift.patch_px", value, cure: PATCH_CURE });
        }
        if d.block_px.is_multiple_of(2) {
            let value = f64::from(d.block_px);
            return Err(VisionError::OutOfRange { name: "detector.block_px", value, cure: "it must be odd" });
        }
        for (name, value) in [
            ("matcher.max_ratio", m.max_ratio),
            ("matcher.sift.max_ratio", m.sift.max_ratio),
            ("klt.min_correlation", k.min_correlation),
            ("rotation.min_inlier_ratio", r.min_inlier_ratio),
            ("rotation.smooth_error_share", r.smooth_error_share),
            ("fixed_center.smooth_error_share", c.smooth_error_share),
        ] {
            if !(0.0..=1.0).contains(&value) {
                return Err(VisionError::OutOfRange { name, value, cure: "it must lie between 0 and 1" });
            }
        }
        Ok(())
    }
}
