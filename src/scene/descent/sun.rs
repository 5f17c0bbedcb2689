//! Where the Sun stands over a landing site.

use crate::scene::{SceneError, limits};
use nalgebra::{Unit, Vector3};
use serde::{Deserialize, Serialize};

/// Direction to the Sun in the site frame; it stands still during a descent.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SunConfig {
    /// Angle above the horizon in degrees, 0 to 90 (default 40).
    pub elevation_deg: f64,
    /// Direction on the ground in degrees from x over y (default 150).
    pub azimuth_deg: f64,
    /// Distance to the Sun in astronomical units, which sets the size of its disc (default 1.52, that of Mars); 0 makes it a
    /// point.
    pub distance_au: f64,
}

impl Default for SunConfig {
    fn default() -> Self {
        SunConfig { elevation_deg: 40.0, azimuth_deg: 150.0, distance_au: 1.52 }
    }
}

impl SunConfig {
    /// Direction to the Sun in the site frame.
    pub fn sun_in_site(&self) -> Unit<Vector3<f64>> {
        let (elevation, azimuth) = (self.elevation_deg.to_radians(), self.azimuth_deg.to_radians());
        let across = elevation.cos();
        Unit::new_normalize(Vector3::new(across * azimuth.cos(), across * azimuth.sin(), elevation.sin()))
    }

    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), SceneError> {
        limits::within("elevation_deg", self.elevation_deg, 0.0, 90.0)?;
        limits::within("azimuth_deg", self.azimuth_deg, -360.0, 360.0)?;
        limits::within("distance_au", self.distance_au, 0.0, 1e4)
    }
}
