//! How the camera is mounted on the lander.

use crate::geometry::so3;
use crate::settings::{OutOfRange, limits};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A camera that looks along -z of the lander (down, against the thrust), right along its x and up along its y, turned
/// toward the site by an angle.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct CameraMountConfig {
    /// Angle in degrees that the optical axis is turned from -z of the lander toward the direction in which the site
    /// stands at t = 0, -90 to 90 (default 0).
    pub cant_deg: f64,
    /// Place of the camera in lander axes, m, -10 to 10 (default 0, 0, 0).
    pub camera_in_lander_m: [f64; 3],
}

impl CameraMountConfig {
    /// Pose of the camera in lander axes; `site_in_lander_m` is the site's origin in lander axes at t = 0.
    pub fn lander_from_camera(&self, site_in_lander_m: &Vector3<f64>) -> Isometry3<f64> {
        let looks_down = UnitQuaternion::new_unchecked(Quaternion::new(0.0, 1.0, 0.0, 0.0)); // half a turn about x
        let axis = (-Vector3::z()).cross(site_in_lander_m).try_normalize(1e-9).unwrap_or(Vector3::zeros());
        let cant = so3::exp(&(axis * self.cant_deg.to_radians()));
        Isometry3::from_parts(Translation3::from(Vector3::from(self.camera_in_lander_m)), cant * looks_down)
    }

    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::within("cant_deg", self.cant_deg, -90.0, 90.0)?;
        for component in self.camera_in_lander_m {
            limits::within("camera_in_lander_m", component, -10.0, 10.0)?;
        }
        Ok(())
    }
}
