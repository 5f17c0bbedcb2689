//! Parameters of the front end.

use super::error::VisionError;
use super::matching::{MatcherConfig, PATCH_CURE, PATCH_RANGE_PX};
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

/// Harris detection.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DetectorConfig {
    /// Most features a picture (default 1000).
    pub max_features: usize,
    /// Gaussian smoothing before detection, 1σ in px (default 1.0).
    pub smoothing_sigma_px: f64,
    /// Gaussian smoothing of the response, 1σ in px (default 0.8).
    pub response_sigma_px: f64,
    /// Side of the window that gathers the structure tensor, px (default 5).
    pub block_px: u32,
    /// Harris' trace factor k (default 0.04).
    pub harris_k: f64,
    /// Least response as a fraction of the strongest (default 1e-5); noise is refused by `max_sigma_px`.
    pub min_response_ratio: f64,
    /// Least distance between features, px (default 5).
    pub min_distance_px: f64,
    /// Features closer to the picture's edge are dropped, px (default 16).
    pub border_px: u32,
    /// Peaks of the response with a greater width are too blunt to be found again at the same place, px (default 2.2).
    pub max_peak_width_px: f64,
    /// Features with a greater predicted 1σ are dropped, px (default 0.4).
    pub max_sigma_px: f64,
}

impl Default for DetectorConfig {
    fn default() -> Self {
        DetectorConfig {
            max_features: 1000,
            smoothing_sigma_px: 1.0,
            response_sigma_px: 0.8,
            block_px: 5,
            harris_k: 0.04,
            min_response_ratio: 1e-5,
            min_distance_px: 5.0,
            border_px: 16,
            max_peak_width_px: 2.2,
            max_sigma_px: 0.4,
        }
    }
}

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

/// Rotation between two pictures.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RotationConfig {
    /// Inlier threshold of the first robust estimate, px (default 1.5).
    pub threshold_px: f64,
    /// Nominal 1σ of a pixel where none is given, px (default 0.3). The fit estimates its own scale from it.
    pub sigma_px: f64,
    /// Fewest matches to try, and fewest inliers to accept (default 20).
    pub min_matches: usize,
    /// Least fraction of the matches that must agree (default 0.3).
    pub min_inlier_ratio: f64,
    /// Greatest 1σ of the rotation about any axis that is still a determined rotation, rad (default 0.02).
    pub max_sigma_rad: f64,
    /// Greatest rotation between two pictures, rad (default 1.0); the twisted solution lies near π.
    pub max_angle_rad: f64,
    /// 1σ of a predicted rotation, rad (default 0.005).
    pub prior_sigma_rad: f64,
    /// Variance of errors that vary smoothly over the picture, as a share of the noise's (default 0.0007). It grows with
    /// the square of the translation over the distance: the looks of ground change with the view. 0 where pixels err by
    /// white noise alone, as simulated ones do.
    pub smooth_error_share: f64,
    /// Seed of the random samples (default 1).
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
            smooth_error_share: 0.0007,
            seed: 1,
        }
    }
}

/// The fixed-centre model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FixedCenterConfig {
    /// 1σ of the first guess of the centre's direction (the centroid of the bright silhouette), rad (default 0.05).
    pub center_sigma_rad: f64,
    /// Width of the band along the limb and the terminator where no feature is taken, px (default 8).
    pub limb_margin_px: u32,
    /// A rate this far from the running median is suspect, rad/s (default 1°/s)…
    pub rate_gate_rad_s: f64,
    /// …or this fraction of the median, whichever is greater (default 0.2).
    pub rate_gate_ratio: f64,
    /// Variance of errors that vary smoothly over the picture, as a share of the noise's (default 0.0018): the light moves
    /// over a body that turns.
    pub smooth_error_share: f64,
    /// Whether a patch's stretch from picture to picture is refined by its own grey levels (default true): a body's surface
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
            smooth_error_share: 0.0018,
            stretch_patches: true,
        }
    }
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
