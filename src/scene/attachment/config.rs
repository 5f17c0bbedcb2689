//! Settings of an attachment scene.

use super::gravity::BodyConfig;
use super::guidance::ApproachConfig;
use super::imu_simulation::NodeImuConfig;
use super::initial_error::NodeErrorConfig;
use super::link::FlexConfig;
use crate::scene::descent::SunConfig;
use crate::scene::terrain::TerrainConfig;
use crate::settings::{OutOfRange, limits};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Linked spacecraft that descend together to a site on a small body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct AttachmentConfig {
    /// Places of the spacecraft in the formation, in site axes from its centre, m; one to 1000 (default: three at the
    /// corners of an equilateral triangle with sides of 1.299 m).
    pub nodes_m: Vec<[f64; 3]>,
    /// Time between images in s, 0.001 to 1e6 (default 30), all nodes at once, the first at t = 0; a multiple of the
    /// inertial measurement units' interval.
    pub picture_interval_s: f64,
    /// Number of landmarks on the ground for the ground truth, 0 to 100000 (default 200), the site's origin included.
    pub landmarks: usize,
    /// Path of the formation's centre.
    pub approach: ApproachConfig,
    /// Vibration of each spacecraft about its place.
    pub flex: FlexConfig,
    /// The body below.
    pub body: BodyConfig,
    /// The inertial measurement unit of each spacecraft.
    pub imu: NodeImuConfig,
    /// Errors of what the spacecraft believe at the start.
    pub initial_error: NodeErrorConfig,
    /// Direction to the Sun at t = 0; it moves as the body turns.
    pub sun: SunConfig,
    /// The ground around the site; a small body has no sky, so `sky_light` must be 0.
    pub terrain: TerrainConfig,
}

impl Default for AttachmentConfig {
    fn default() -> Self {
        AttachmentConfig {
            nodes_m: vec![[-0.6495, -0.375, 0.0], [0.6495, -0.375, 0.0], [0.0, 0.75, 0.0]],
            picture_interval_s: 30.0,
            landmarks: 200,
            approach: ApproachConfig::default(),
            flex: FlexConfig::default(),
            body: BodyConfig::default(),
            imu: NodeImuConfig::default(),
            initial_error: NodeErrorConfig::default(),
            sun: SunConfig::default(),
            terrain: TerrainConfig { sky_light: 0.0, ..TerrainConfig::default() },
        }
    }
}

impl AttachmentConfig {
    /// Times of the images in ns.
    pub fn times_ns(&self) -> Vec<i64> {
        let interval_ns = (self.picture_interval_s * 1e9).round() as i64;
        let end_ns = (self.approach.duration_s * 1e9).round() as i64;
        (0..=end_ns / interval_ns).map(|index| index * interval_ns).collect()
    }

    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::count("nodes_m", self.nodes_m.len(), 1, 1000)?;
        self.nodes_m.iter().try_for_each(|place_m| limits::finite("nodes_m", place_m))?;
        self.imu.validate().map_err(|e| e.under("imu"))?;
        self.approach.validate().map_err(|e| e.under("approach"))?;
        limits::within("picture_interval_s", self.picture_interval_s, 1e-3, 1e6)?;
        if (self.picture_interval_s * 1e9).round() as i64 % self.imu.interval_ns() != 0 {
            let cure = format!("it must be a multiple of the interval of the {} Hz of imu.rate_hz", self.imu.rate_hz);
            return Err(OutOfRange::new("picture_interval_s", self.picture_interval_s, cure));
        }
        limits::count("landmarks", self.landmarks, 0, 100_000)?;
        self.flex.validate().map_err(|e| e.under("flex"))?;
        self.body.validate().map_err(|e| e.under("body"))?;
        self.initial_error.validate().map_err(|e| e.under("initial_error"))?;
        self.sun.validate().map_err(|e| e.under("sun"))?;
        limits::within("terrain.sky_light", self.terrain.sky_light, 0.0, 0.0)?;
        self.terrain.validate().map_err(|e| e.under("terrain"))?;
        self.terrain.photometry.validate(self.terrain.albedo).map_err(|e| e.under("terrain"))
    }
}
