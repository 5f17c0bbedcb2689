//! The phase angle of a tumbling scene.

use crate::scene::error::SceneError;
use crate::scene::light::{EphemerisConfig, Sunlight, direction};
use crate::settings::{OutOfRange, limits};
use nalgebra::{Unit, UnitQuaternion, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Direction to the Sun as the camera sees it; fixed in inertial axes. An ephemeris goes before a vector, a vector before
/// the two angles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct PhaseConfig {
    /// Angle at the body between camera and Sun in degrees, 0 to 180 (default 35).
    pub phase_deg: f64,
    /// Direction in the image that the light comes from, in degrees from right over up, -360 to 360 (default 135:
    /// upper left).
    pub azimuth_deg: f64,
    /// Distance to the Sun in astronomical units, which sets the size of its disc, 0 to 10000 (default 1); 0 makes it a
    /// point. An ephemeris knows better.
    pub distance_au: f64,
    /// Vector toward the Sun in inertial axes, of any length (default none).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub direction_in_inertial: Option<[f64; 3]>,
    /// SPICE kernels that tell where the Sun stands (default none); `inertial_from_icrf` of the scenario turns it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ephemeris: Option<EphemerisConfig>,
}

impl Default for PhaseConfig {
    fn default() -> Self {
        PhaseConfig {
            phase_deg: 35.0,
            azimuth_deg: 135.0,
            distance_au: 1.0,
            direction_in_inertial: None,
            ephemeris: None,
        }
    }
}

impl PhaseConfig {
    /// The Sun in the nominal camera's axes, which are inertial, for a body whose centre is at `center_in_camera_m`;
    /// `base_folder` is where relative paths of kernels start.
    ///
    /// # Errors
    /// Names the kernel or the key at fault.
    pub fn sunlight_in_camera(
        &self,
        center_in_camera_m: &Vector3<f64>,
        inertial_from_icrf: &UnitQuaternion<f64>,
        base_folder: &Path,
    ) -> Result<Sunlight, SceneError> {
        if let Some(ephemeris) = &self.ephemeris {
            let sun = ephemeris.sun(base_folder)?;
            return Ok(Sunlight {
                direction: inertial_from_icrf * sun.direction_in_icrf,
                distance_au: sun.distance_au,
            });
        }
        let given = self.direction_in_inertial.map(|vector| direction("direction_in_inertial", &vector)).transpose()?;
        let direction = given.unwrap_or_else(|| self.direction_from_angles(center_in_camera_m));
        Ok(Sunlight { direction, distance_au: self.distance_au })
    }

    fn direction_from_angles(&self, center_in_camera_m: &Vector3<f64>) -> Unit<Vector3<f64>> {
        let to_camera = -center_in_camera_m.normalize();
        let right = (Vector3::x() - to_camera * to_camera.x).normalize();
        let up = to_camera.cross(&right);
        let (phase, azimuth) = (self.phase_deg.to_radians(), self.azimuth_deg.to_radians());
        let sideways = right * azimuth.cos() + up * azimuth.sin();
        Unit::new_normalize(to_camera * phase.cos() + sideways * phase.sin())
    }

    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::within("phase_deg", self.phase_deg, 0.0, 180.0)?;
        limits::within("azimuth_deg", self.azimuth_deg, -360.0, 360.0)?;
        limits::within("distance_au", self.distance_au, 0.0, 1e4)?;
        let given = self.direction_in_inertial;
        given.map_or(Ok(()), |vector| direction("direction_in_inertial", &vector).map(|_| ()))?;
        self.ephemeris.as_ref().map_or(Ok(()), EphemerisConfig::validate)
    }
}
