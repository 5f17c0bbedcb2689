//! Options of the landing navigation.

use super::error_state::FilterKind;
use super::inertial::Planet;
use crate::navigation::filter::Gate;
use crate::navigation::landmark::{GroundPrior, Selector};
use crate::settings::{OutOfRange, limits};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// How an unknown landmark gets its first place.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "settings", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum LandmarkStart {
    /// Where its first bearing meets the plane of the ground, at once.
    #[default]
    Plane,
    /// Where two of its bearings meet, once they do so at an angle: nothing is taken to be known of the ground.
    Delayed,
}

/// What is known of the IMU's biases at the start: 0, give or take.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "settings", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct BiasPrior {
    /// 1σ of the gyroscope's bias, each axis, rad/s, above 0.
    pub sigma_gyroscope_rad_s: f64,
    /// 1σ of the accelerometer's bias, each axis, m/s², above 0.
    pub sigma_accelerometer_m_s2: f64,
}

/// Options of [`navigate`](super::navigate).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "settings", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct LandingConfig {
    /// Coordinates of the error state (default hybrid).
    pub filter: FilterKind,
    /// How unknown landmarks are chosen (default depth-error).
    pub selector: Selector,
    /// Number of unknown landmarks observed at a time, 0 to 50 (default 1, the paper's; 3 that are kept for 8 observations
    /// halve the error of the height).
    pub unknown_landmarks: usize,
    /// Accepted observations of an unknown landmark, after the one that initialises it, before another may take its place,
    /// 1 or more (default 3).
    pub reselect_after: usize,
    /// How an unknown landmark gets its first place (default plane).
    pub landmark_start: LandmarkStart,
    /// Least angle at which two bearings place a landmark without a plane, rad, between 0 and 1.5 (default 0.05).
    pub least_parallax_rad: f64,
    /// Gravity at the site, downward, m/s², 0 or more (default 3.711, Mars).
    pub gravity_m_s2: f64,
    /// Rotation of the planet in the site's axes, rad/s, its norm below 0.01 (default 0, 0, 0, as in the paper; Mars turns
    /// by 7.088e-5 about its own axis).
    pub planet_rate_in_site_rad_s: [f64; 3],
    /// Estimate the biases of the IMU (default: they are 0).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub biases: Option<BiasPrior>,
    /// What is done with the rotations between images (default check).
    pub image_rotation: ImageRotationUse,
    /// Whether the noise of a bearing counts what its curvature leaves unmodelled (default true).
    pub second_order_noise: bool,
    /// Images from a lower estimated height than this are not used, m, above 0 (default 15).
    pub minimum_image_height_m: f64,
    /// Least 1σ of a pixel coordinate, px, whatever the tracker claims, above 0 (default 0.1).
    pub sigma_floor_px: f64,
    /// Probability that a good measurement passes the gate, between 0 and 1 (default 0.9999).
    pub gate_confidence: f64,
    /// Gauss–Newton steps of the first correction, 1 or more (default 6); later ones take one step.
    pub first_iterations: usize,
    /// A new landmark has to stay this far from the image's edge while it is needed, px, 0 or more (default 4).
    pub edge_margin_px: f64,
    /// What is known of the ground's height.
    pub ground: GroundPrior,
    /// 1σ of the designated point's pixel in the first image, px, 0 or more (default 0: it is the site's origin exactly).
    pub designated_sigma_px: f64,
    /// 1σ by which the tracker drifts off the designated point an image, px, 0 or more (default 0).
    pub designated_drift_px: f64,
    /// What images show otherwise than a map stays wrong in the same way until the scale has changed by this, as a natural
    /// logarithm, 0 or more (default 0: each image errs on its own). With a map, the noise model's counts.
    pub map_shared_ln_scale: f64,
    /// Seed of the random selector, 0 to 2⁶³-1 (default 0).
    pub seed: u64,
}

impl Default for LandingConfig {
    fn default() -> Self {
        LandingConfig {
            filter: FilterKind::Hybrid,
            selector: Selector::DepthError,
            unknown_landmarks: 1,
            reselect_after: 3,
            landmark_start: LandmarkStart::Plane,
            least_parallax_rad: 0.05,
            gravity_m_s2: 3.711,
            planet_rate_in_site_rad_s: [0.0; 3],
            biases: None,
            image_rotation: ImageRotationUse::Check,
            second_order_noise: true,
            minimum_image_height_m: 15.0,
            sigma_floor_px: 0.1,
            gate_confidence: 0.9999,
            first_iterations: 6,
            edge_margin_px: 4.0,
            ground: GroundPrior::default(),
            designated_sigma_px: 0.0,
            designated_drift_px: 0.0,
            map_shared_ln_scale: 0.0,
            seed: 0,
        }
    }
}

impl LandingConfig {
    /// Options for bearings from real images: three unknown landmarks at a time, each kept for at least eight
    /// observations, since long tracks bring the parallax that short ones lack.
    pub fn from_pixels() -> Self {
        LandingConfig { unknown_landmarks: 3, reselect_after: 8, ..LandingConfig::default() }
    }

    /// Gravity and rotation of the site.
    pub fn planet(&self) -> Planet {
        Planet {
            gravity_in_site_m_s2: Vector3::new(0.0, 0.0, -self.gravity_m_s2),
            rate_in_site_rad_s: Vector3::from(self.planet_rate_in_site_rad_s),
        }
    }

    /// The innovation gate.
    pub fn gate(&self) -> Gate {
        Gate { confidence: self.gate_confidence }
    }

    /// Checks every range.
    ///
    /// # Errors
    /// Names the key and the cure.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::count("unknown_landmarks", self.unknown_landmarks, 0, 50)?;
        limits::count_from("reselect_after", self.reselect_after, 1)?;
        limits::between("least_parallax_rad", self.least_parallax_rad, 0.0, 1.5)?;
        limits::at_least("gravity_m_s2", self.gravity_m_s2, 0.0)?;
        let rate_rad_s = Vector3::from(self.planet_rate_in_site_rad_s).norm();
        if rate_rad_s.is_nan() || rate_rad_s >= 1e-2 {
            let cure = "its norm must be below 0.01 rad/s; Mars turns by 7.088e-5";
            return Err(OutOfRange::new("planet_rate_in_site_rad_s", rate_rad_s, cure));
        }
        self.biases.map_or(Ok(()), |prior| prior.validate()).map_err(|e| e.under("biases"))?;
        limits::positive("minimum_image_height_m", self.minimum_image_height_m)?;
        limits::positive("sigma_floor_px", self.sigma_floor_px)?;
        limits::between("gate_confidence", self.gate_confidence, 0.0, 1.0)?;
        limits::count_from("first_iterations", self.first_iterations, 1)?;
        limits::at_least("edge_margin_px", self.edge_margin_px, 0.0)?;
        self.ground.validate().map_err(|e| e.under("ground"))?;
        limits::at_least("designated_sigma_px", self.designated_sigma_px, 0.0)?;
        limits::at_least("designated_drift_px", self.designated_drift_px, 0.0)?;
        limits::at_least("map_shared_ln_scale", self.map_shared_ln_scale, 0.0)?;
        limits::seed("seed", self.seed)
    }
}

impl BiasPrior {
    /// Checks every range.
    ///
    /// # Errors
    /// Names the key and the cure.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::positive("sigma_gyroscope_rad_s", self.sigma_gyroscope_rad_s)?;
        limits::positive("sigma_accelerometer_m_s2", self.sigma_accelerometer_m_s2)
    }
}

/// What is done with the rotations that images tell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "settings", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum ImageRotationUse {
    /// They are compared with the gyroscope's; the estimate does not depend on them.
    #[default]
    Check,
    /// They correct the gyroscope's, or its bias where biases are estimated.
    Measure,
    /// Nothing.
    Ignore,
}
