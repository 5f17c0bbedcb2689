//! Settings of a descent.

use super::camera_mount::CameraMountConfig;
use super::guidance::{GuidanceConfig, PolynomialGuidance};
use super::imu_simulation::ImuConfig;
use super::initial_error::InitialErrorConfig;
use super::schedule::FrameSchedule;
use super::sun::SunConfig;
use crate::scene::elevation::{ElevationConfig, OrthoimageConfig};
use crate::scene::terrain::TerrainConfig;
use crate::settings::{OutOfRange, limits};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A powered descent to a landing site.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct DescentConfig {
    /// Number of landmarks on the ground for the ground truth, 0 to 100000 (default 200), the site's origin included.
    pub landmarks: usize,
    /// When images are taken (default: once a second).
    pub schedule: FrameSchedule,
    /// The path.
    pub guidance: GuidanceConfig,
    /// How the camera is mounted.
    pub camera_mount: CameraMountConfig,
    /// The inertial measurement unit.
    pub imu: ImuConfig,
    /// Errors of what the lander believes at the first image.
    pub initial_error: InitialErrorConfig,
    /// Direction to the Sun.
    pub sun: SunConfig,
    /// The ground.
    pub terrain: TerrainConfig,
    /// A measured elevation model as the base of the ground (default none: the ground is procedural alone).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub elevation: Option<Box<ElevationConfig>>,
    /// A measured image of the ground's albedo (default none).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub orthoimage: Option<Box<OrthoimageConfig>>,
}

impl Default for DescentConfig {
    fn default() -> Self {
        DescentConfig {
            landmarks: 200,
            schedule: FrameSchedule::default(),
            guidance: GuidanceConfig::default(),
            camera_mount: CameraMountConfig::default(),
            imu: ImuConfig::default(),
            initial_error: InitialErrorConfig::default(),
            sun: SunConfig::default(),
            terrain: TerrainConfig::default(),
            elevation: None,
            orthoimage: None,
        }
    }
}

impl DescentConfig {
    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::count("landmarks", self.landmarks, 0, 100_000)?;
        self.guidance.validate().map_err(|e| e.under("guidance"))?;
        let path = PolynomialGuidance::new(&self.guidance);
        self.schedule.validate(&path).map_err(|e| e.under("schedule"))?;
        self.camera_mount.validate().map_err(|e| e.under("camera_mount"))?;
        self.imu.validate().map_err(|e| e.under("imu"))?;
        self.initial_error.validate().map_err(|e| e.under("initial_error"))?;
        self.sun.validate().map_err(|e| e.under("sun"))?;
        self.terrain.validate().map_err(|e| e.under("terrain"))?;
        self.terrain.photometry.validate(self.terrain.albedo).map_err(|e| e.under("terrain"))?;
        self.elevation.as_ref().map_or(Ok(()), |e| e.validate()).map_err(|e| e.under("elevation"))?;
        self.orthoimage.as_ref().map_or(Ok(()), |o| o.validate()).map_err(|e| e.under("orthoimage"))
    }
}
