//! What a campaign varies.

use crate::geometry::Camera;
use crate::navigation::landing::{CameraMount, LandingConfig, Planet};
use crate::scene::{GuidanceConfig, GuidanceProfile};
use crate::settings::{OutOfRange, limits};
use nalgebra::{Isometry3, UnitQuaternion, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What the lander can see.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FieldOfView {
    /// Every direction, and a surface point wherever one is wished for: the paper's simulation.
    #[default]
    Everywhere,
    /// A 90° camera along the thrust axis, and features at random places of its image.
    Wide,
    /// A 60° camera turned 20° towards the site.
    Canted,
}

impl FieldOfView {
    /// The camera, 1024² pixels; `None` for every direction.
    pub fn mount(self) -> Option<CameraMount> {
        // The camera's z axis looks along -z of the lander, its x along the lander's x.
        let down = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
        let (fov_deg, cant_deg) = match self {
            FieldOfView::Everywhere => return None,
            FieldOfView::Wide => (90.0_f64, 0.0_f64),
            FieldOfView::Canted => (60.0, 20.0),
        };
        // The site lies towards -x, -y of the start: the camera turns about the axis across that.
        let across = nalgebra::Unit::new_normalize(Vector3::z().cross(&Vector3::new(-3300.0, -5870.0, 0.0)));
        let cant = UnitQuaternion::from_axis_angle(&across, -cant_deg.to_radians());
        Some(CameraMount {
            camera: Camera::from_fov(1024, 1024, fov_deg.to_radians()),
            lander_from_camera: Isometry3::from_parts(Vector3::zeros().into(), cant * down),
        })
    }
}

/// Options of a campaign of simulated landings.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct CampaignOptions {
    /// Number of flights, 1 to 1000000 (default 300).
    pub runs: u64,
    /// Seed, 0 to 2⁶³-1 (default 1); flight k of a seed is the same whatever else is flown.
    pub seed: u64,
    /// The filter's options.
    pub filter: LandingConfig,
    /// The path.
    pub guidance: GuidanceConfig,
    /// True rotation of the planet in the site's axes, rad/s (default 0, 0, 0); the filter has its own.
    pub planet_rate_in_site_rad_s: [f64; 3],
    /// What the lander sees (default everywhere).
    pub field_of_view: FieldOfView,
    /// 1σ of a bearing, rad, above 0 (default 1e-3).
    pub sigma_bearing_rad: f64,
    /// Share of bearings that are wrong by up to 20°, 0 to 0.5 (default 0).
    pub outlier_share: f64,
    /// Heights of smooth relief, m, 0 to 200 (default 0): then neighbouring landmarks have neighbouring heights. 0 draws
    /// each landmark's height from the ground prior, as the reference simulation does.
    pub relief_m: f64,
    /// Places of further known landmarks, site frame, m (default none).
    pub known_landmarks_m: Vec<[f64; 3]>,
    /// Accelerometer noise of a step of 1 s, m/s², above 0 (default 5e-4).
    pub sigma_force_m_s2: f64,
    /// Gyroscope noise of a step of 1 s, °/s, above 0 (default 2.78e-5).
    pub sigma_rate_deg_s: f64,
}

impl Default for CampaignOptions {
    fn default() -> Self {
        CampaignOptions {
            runs: 300,
            seed: 1,
            filter: LandingConfig {
                // Three images a landmark, the first of which places it.
                reselect_after: 2,
                gate_confidence: 1.0 - 1e-9,
                ..LandingConfig::default()
            },
            guidance: GuidanceConfig::default(),
            planet_rate_in_site_rad_s: [0.0; 3],
            field_of_view: FieldOfView::Everywhere,
            sigma_bearing_rad: 1e-3,
            outlier_share: 0.0,
            relief_m: 0.0,
            known_landmarks_m: Vec::new(),
            sigma_force_m_s2: 5e-4,
            sigma_rate_deg_s: 2.78e-5,
        }
    }
}

impl CampaignOptions {
    /// The path of fifth degree that starts with the paper's attitude: roll -25.7°, pitch -9.8°.
    pub fn papers_attitude() -> GuidanceConfig {
        GuidanceConfig {
            profile: GuidanceProfile::Quintic { initial_acceleration_m_s2: [-0.767, 2.168, 0.729] },
            ..GuidanceConfig::default()
        }
    }

    /// The true planet.
    pub fn planet(&self) -> Planet {
        Planet {
            gravity_in_site_m_s2: self.guidance.gravity_in_site_m_s2(),
            rate_in_site_rad_s: Vector3::from(self.planet_rate_in_site_rad_s),
        }
    }

    /// Checks every range.
    ///
    /// # Errors
    /// Names the option at fault.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::count("runs", self.runs as usize, 1, 1_000_000)?;
        limits::seed("seed", self.seed)?;
        self.filter.validate().map_err(|e| e.under("filter"))?;
        self.guidance.validate().map_err(|e| e.under("guidance"))?;
        limits::finite("planet_rate_in_site_rad_s", &self.planet_rate_in_site_rad_s)?;
        limits::positive("sigma_bearing_rad", self.sigma_bearing_rad)?;
        limits::within("outlier_share", self.outlier_share, 0.0, 0.5)?;
        limits::within("relief_m", self.relief_m, 0.0, 200.0)?;
        limits::finite("known_landmarks_m", self.known_landmarks_m.as_flattened())?;
        limits::positive("sigma_force_m_s2", self.sigma_force_m_s2)?;
        limits::positive("sigma_rate_deg_s", self.sigma_rate_deg_s)
    }
}
