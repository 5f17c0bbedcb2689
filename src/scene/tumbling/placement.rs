//! Where a small body and the Sun stand in the camera frame.

use super::config::TumblingConfig;
use crate::geometry::Camera;
use crate::scene::body::Mesh;
use crate::scene::error::SceneError;
use crate::scene::light::{EphemerisConfig, Sunlight, direction};
use crate::settings::limits;
use nalgebra::{Unit, UnitQuaternion, Vector2, Vector3};
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
    /// Direction in the picture that the light comes from, in degrees from right over up, -360 to 360 (default 135:
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
    pub fn validate(&self) -> Result<(), SceneError> {
        limits::within("phase_deg", self.phase_deg, 0.0, 180.0)?;
        limits::within("azimuth_deg", self.azimuth_deg, -360.0, 360.0)?;
        limits::within("distance_au", self.distance_au, 0.0, 1e4)?;
        let given = self.direction_in_inertial;
        given.map_or(Ok(()), |vector| direction("direction_in_inertial", &vector).map(|_| ()))?;
        self.ephemeris.as_ref().map_or(Ok(()), EphemerisConfig::validate)
    }
}

/// Where the camera is at the first picture: at a distance from the body's centre, in m.
pub(super) fn first_distance_m(
    config: &TumblingConfig,
    camera: &Camera,
    mesh: &Mesh,
    toward_center: &Unit<Vector3<f64>>,
) -> f64 {
    if let Some(distance_m) = config.distance_m {
        return distance_m;
    }
    if let Some(range_m) = config.range_m {
        let outward = -(config.attitude() * toward_center.into_inner());
        let ground_m = mesh.last_crossing_m(&Vector3::zeros(), &outward).unwrap_or(0.0);
        return ground_m + range_m;
    }
    distance_to_fill_m(camera, mesh.radius_m(), config.fill_fraction)
}

/// Distance in m of a sphere of `radius_m` that fills `fill_fraction` of the picture's smaller side when it is in the
/// middle. The silhouette of a sphere at distance D has the half-angle asin(R/D).
fn distance_to_fill_m(camera: &Camera, radius_m: f64, fill_fraction: f64) -> f64 {
    let half_side = (0.5 * size_px(camera)).component_div(&camera.focal_px).min();
    // Distortion that cannot be inverted here leaves the pinhole's size.
    let distorted = Vector2::new(half_side, 0.0);
    let half_side = camera.distortion.undistort(&distorted).unwrap_or(distorted).norm();
    radius_m / (fill_fraction * half_side).atan().sin()
}

fn size_px(camera: &Camera) -> Vector2<f64> {
    Vector2::new(f64::from(camera.width_px), f64::from(camera.height_px))
}

/// Direction in camera axes of a pixel, given from the picture's middle to the right and down.
pub(super) fn toward_pixel(camera: &Camera, offset_px: &Vector2<f64>) -> Unit<Vector3<f64>> {
    let pixel_px = (0.5 * size_px(camera)).add_scalar(-0.5) + offset_px;
    // Distortion that cannot be inverted here leaves the pinhole's direction; it only moves the body a little.
    let pinhole = || (pixel_px - camera.center_px).component_div(&camera.focal_px);
    camera.unproject(&pixel_px).unwrap_or_else(|| Unit::new_normalize(pinhole().push(1.0)))
}
