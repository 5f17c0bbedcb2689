//! Settings of a tumbling scene.

use super::inertia::InertiaSource;
use super::phase::PhaseConfig;
use crate::scene::body::{BodySource, SurfaceConfig};
use crate::scene::stars::SkyConfig;
use crate::settings::{OutOfRange, limits};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A body that tumbles without torque in front of a camera that does not turn. Inertial axes are the camera's.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct TumblingConfig {
    /// Number of images, 1 to 100000 (default 60), the first at t = 0.
    pub frames: usize,
    /// Time between images in s, 1e-6 to 1e6 (default 1).
    pub interval_s: f64,
    /// Angular rate at t = 0 in asteroid axes, °/s, -360 to 360 (default 5.0, 2.3, 3.5).
    pub rate_deg_s: [f64; 3],
    /// Attitude at t = 0 as a quaternion w, x, y, z that takes inertial to asteroid axes (default 1, 0, 0, 0).
    pub asteroid_from_inertial: [f64; 4],
    /// Quaternion w, x, y, z that takes ICRF axes to inertial ones, that is, to the camera's; only the stars and the Sun's
    /// ephemeris need it (default 1, 0, 0, 0: the camera looks at the celestial north pole, right ascension 0 to the right).
    pub inertial_from_icrf: [f64; 4],
    /// Diameter of the body's bounding sphere over the smaller side of the image, 0 to 1 (default 0.7).
    pub fill_fraction: f64,
    /// Distance at t = 0 from the camera to the body's centre in m, instead of `fill_fraction` (default none).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distance_m: Option<f64>,
    /// Distance at t = 0 from the camera to the surface in m, along the line to the body's centre, instead of
    /// `fill_fraction` (default none).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub range_m: Option<f64>,
    /// Speed of the camera toward the body's centre in m/s, negative to draw back, -100000 to 100000 (default 0).
    pub approach_m_s: f64,
    /// Place of the body's centre in the image, right and down from the middle, in px (default 0, 0).
    pub center_offset_px: [f64; 2],
    /// Number of landmarks on the surface for the ground truth, 0 to 100000 (default 200).
    pub landmarks: usize,
    /// Inertia (default: the tensor of Deng et al. 2024).
    pub inertia: InertiaSource,
    /// Direction to the Sun.
    pub sun: PhaseConfig,
    /// What is behind the body.
    pub sky: SkyConfig,
    /// Surface.
    pub surface: SurfaceConfig,
    /// Shape (default: procedural).
    pub shape: BodySource,
}

impl Default for TumblingConfig {
    fn default() -> Self {
        TumblingConfig {
            frames: 60,
            interval_s: 1.0,
            rate_deg_s: [5.0, 2.3, 3.5],
            asteroid_from_inertial: [1.0, 0.0, 0.0, 0.0],
            inertial_from_icrf: [1.0, 0.0, 0.0, 0.0],
            fill_fraction: 0.7,
            distance_m: None,
            range_m: None,
            approach_m_s: 0.0,
            center_offset_px: [0.0, 0.0],
            landmarks: 200,
            inertia: InertiaSource::default(),
            sun: PhaseConfig::default(),
            sky: SkyConfig::default(),
            surface: SurfaceConfig::default(),
            shape: BodySource::default(),
        }
    }
}

impl TumblingConfig {
    /// Angular rate at t = 0 in asteroid axes, rad/s.
    pub fn rate_rad_s(&self) -> Vector3<f64> {
        Vector3::from(self.rate_deg_s).map(f64::to_radians)
    }

    /// Attitude at t = 0.
    pub fn attitude(&self) -> UnitQuaternion<f64> {
        rotation(&self.asteroid_from_inertial)
    }

    /// Rotation from ICRF axes to inertial ones.
    pub fn icrf_rotation(&self) -> UnitQuaternion<f64> {
        rotation(&self.inertial_from_icrf)
    }

    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::count("frames", self.frames, 1, 100_000)?;
        limits::within("interval_s", self.interval_s, 1e-6, 1e6)?;
        limits::finite("rate_deg_s", &self.rate_deg_s)?;
        for rate_deg_s in self.rate_deg_s {
            limits::within("rate_deg_s", rate_deg_s, -360.0, 360.0)?;
        }
        limits::unit_quaternion("asteroid_from_inertial", &self.asteroid_from_inertial)?;
        limits::unit_quaternion("inertial_from_icrf", &self.inertial_from_icrf)?;
        limits::within("fill_fraction", self.fill_fraction, 1e-3, 1.0)?;
        self.validate_distance()?;
        limits::finite("center_offset_px", &self.center_offset_px)?;
        limits::count("landmarks", self.landmarks, 0, 100_000)?;
        self.inertia.validate()?;
        self.sun.validate().map_err(|e| e.under("sun"))?;
        self.sky.validate().map_err(|e| e.under("sky"))?;
        self.surface.validate().map_err(|e| e.under("surface"))?;
        self.shape.validate().map_err(|e| e.under("shape"))
    }

    fn validate_distance(&self) -> Result<(), OutOfRange> {
        if let (Some(_), Some(range_m)) = (self.distance_m, self.range_m) {
            return Err(OutOfRange::new("range_m", range_m, "distance_m is given too: drop one of them"));
        }
        let (key, value) = self.distance_key();
        if key != "fill_fraction" {
            limits::within(key, value, 1e-3, 1e9)?;
        }
        limits::within("approach_m_s", self.approach_m_s, -1e5, 1e5)
    }

    /// The key that decides on the distance, and its value.
    pub(super) fn distance_key(&self) -> (&'static str, f64) {
        match (self.distance_m, self.range_m) {
            (Some(distance_m), _) => ("distance_m", distance_m),
            (None, Some(range_m)) => ("range_m", range_m),
            (None, None) => ("fill_fraction", self.fill_fraction),
        }
    }
}

fn rotation([w, x, y, z]: &[f64; 4]) -> UnitQuaternion<f64> {
    UnitQuaternion::from_quaternion(Quaternion::new(*w, *x, *y, *z))
}
