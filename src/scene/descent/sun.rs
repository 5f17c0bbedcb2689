//! Where the Sun stands over a landing site.

use crate::scene::error::SceneError;
use crate::scene::light::{EphemerisConfig, Sunlight, direction};
use crate::settings::{OutOfRange, limits};
use nalgebra::{Quaternion, Unit, UnitQuaternion, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Direction to the Sun in the site frame; it stands still during a descent. An ephemeris goes before a vector, a vector
/// before the two angles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SunConfig {
    /// Angle above the horizon in degrees, 0 to 90 (default 40).
    pub elevation_deg: f64,
    /// Direction on the ground in degrees from x over y, -360 to 360 (default 150).
    pub azimuth_deg: f64,
    /// Vector toward the Sun in the site frame, of any length (default none).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub direction_in_site: Option<[f64; 3]>,
    /// Distance to the Sun in astronomical units, which sets the size of its disc, 0 to 10000 (default 1.52, that of
    /// Mars); 0 makes it a point. An ephemeris knows better.
    pub distance_au: f64,
    /// Quaternion w, x, y, z that takes ICRF axes to the site's at the time of the descent (default 1, 0, 0, 0); only the
    /// ephemeris needs it.
    pub site_from_icrf: [f64; 4],
    /// SPICE kernels that tell where the Sun stands (default none).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ephemeris: Option<EphemerisConfig>,
}

impl Default for SunConfig {
    fn default() -> Self {
        SunConfig {
            elevation_deg: 40.0,
            azimuth_deg: 150.0,
            direction_in_site: None,
            distance_au: 1.52,
            site_from_icrf: [1.0, 0.0, 0.0, 0.0],
            ephemeris: None,
        }
    }
}

impl SunConfig {
    /// The Sun in the site frame; `base_folder` is where relative paths of kernels start.
    ///
    /// # Errors
    /// Names the kernel or the key at fault.
    pub fn sunlight_in_site(&self, base_folder: &Path) -> Result<Sunlight, SceneError> {
        if let Some(ephemeris) = &self.ephemeris {
            let sun = ephemeris.sun(base_folder)?;
            let [w, x, y, z] = self.site_from_icrf;
            let site_from_icrf = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
            return Ok(Sunlight { direction: site_from_icrf * sun.direction_in_icrf, distance_au: sun.distance_au });
        }
        let given = self.direction_in_site.map(|vector| direction("direction_in_site", &vector)).transpose()?;
        Ok(Sunlight { direction: given.unwrap_or_else(|| self.direction_from_angles()), distance_au: self.distance_au })
    }

    fn direction_from_angles(&self) -> Unit<Vector3<f64>> {
        let (elevation, azimuth) = (self.elevation_deg.to_radians(), self.azimuth_deg.to_radians());
        let across = elevation.cos();
        Unit::new_normalize(Vector3::new(across * azimuth.cos(), across * azimuth.sin(), elevation.sin()))
    }

    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::within("elevation_deg", self.elevation_deg, 0.0, 90.0)?;
        limits::within("azimuth_deg", self.azimuth_deg, -360.0, 360.0)?;
        limits::within("distance_au", self.distance_au, 0.0, 1e4)?;
        limits::unit_quaternion("site_from_icrf", &self.site_from_icrf)?;
        self.direction_in_site.map_or(Ok(()), |vector| direction("direction_in_site", &vector).map(|_| ()))?;
        self.ephemeris.as_ref().map_or(Ok(()), EphemerisConfig::validate)
    }
}
