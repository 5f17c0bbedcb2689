//! From where, and how well known, landmarks are seen.

use crate::settings::{OutOfRange, limits};
use nalgebra::{Rotation3, SMatrix, Unit, Vector3};
use serde::{Deserialize, Serialize};

/// What is known of the ground before it is measured: its height above the site's plane z = 0.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "settings", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct GroundPrior {
    /// Largest 1σ of the height, m, no less than `sigma_floor_m` (default 30).
    pub sigma_height_m: f64,
    /// 1σ of the height per metre of horizontal distance from the site, where it is 0, 0 or more (default 0.08).
    pub sigma_slope: f64,
    /// 1σ that remains at the site, m, above 0 (default 0.1).
    pub sigma_floor_m: f64,
    /// Landmarks farther than this from nadir, as seen by the lander, are not used, rad, between 0 and 1.5
    /// (default 1.2217, 70°).
    pub largest_off_nadir_rad: f64,
}

impl Default for GroundPrior {
    /// min(30 m, 0.08 of the distance), 70° off nadir.
    fn default() -> Self {
        GroundPrior {
            sigma_height_m: 30.0,
            sigma_slope: 0.08,
            sigma_floor_m: 0.1,
            largest_off_nadir_rad: 70f64.to_radians(),
        }
    }
}

impl GroundPrior {
    /// Checks every range.
    ///
    /// # Errors
    /// Names the key and the cure.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::positive("sigma_floor_m", self.sigma_floor_m)?;
        limits::at_least("sigma_height_m", self.sigma_height_m, self.sigma_floor_m)?;
        limits::at_least("sigma_slope", self.sigma_slope, 0.0)?;
        limits::between("largest_off_nadir_rad", self.largest_off_nadir_rad, 0.0, 1.5)
    }

    /// 1σ of the ground's height (m) at a point of the site frame.
    pub fn sigma_at_m(&self, point_in_site_m: &Vector3<f64>) -> f64 {
        self.sigma_at_distance_m(point_in_site_m.xy().norm())
    }

    /// 1σ of the ground's height (m) at a horizontal distance (m) from the site.
    pub fn sigma_at_distance_m(&self, distance_m: f64) -> f64 {
        (self.sigma_slope * distance_m).clamp(self.sigma_floor_m, self.sigma_height_m)
    }
}

/// The lander's estimated state where a landmark has to be chosen.
#[derive(Debug, Clone, PartialEq)]
pub struct Viewpoint {
    /// Position of the lander in the site frame, m.
    pub lander_in_site_m: Vector3<f64>,
    /// Velocity of the lander in the site frame, m/s.
    pub lander_velocity_in_site_m_s: Vector3<f64>,
    /// Specific force (acceleration less gravity) in the site frame, m/s².
    pub specific_force_in_site_m_s2: Vector3<f64>,
    /// Gravity in the site frame, m/s².
    pub gravity_in_site_m_s2: Vector3<f64>,
    /// Time between observations, s.
    pub interval_s: f64,
    /// 1σ of a bearing, rad.
    pub sigma_bearing_rad: f64,
    /// Covariance of the errors of position (m), velocity (m/s) and attitude (rad), all in site axes.
    pub covariance: SMatrix<f64, 9, 9>,
    /// What is known of the ground.
    pub ground: GroundPrior,
}

impl Viewpoint {
    /// Path angle γ below the horizontal, rad.
    pub fn path_angle_rad(&self) -> f64 {
        let v = self.lander_velocity_in_site_m_s;
        (-v.z).atan2(v.xy().norm())
    }

    /// Unit vector of the horizontal velocity in site axes; x for a vertical descent.
    pub fn course_in_site(&self) -> Vector3<f64> {
        let v = self.lander_velocity_in_site_m_s;
        Vector3::new(v.x, v.y, 0.0).try_normalize(1e-9).unwrap_or(Vector3::x())
    }

    /// Where the lander will be after `time_s` under constant specific force, m in the site frame.
    pub fn predicted_position_in_site_m(&self, time_s: f64) -> Vector3<f64> {
        let acceleration_m_s2 = self.specific_force_in_site_m_s2 + self.gravity_in_site_m_s2;
        self.lander_in_site_m + self.lander_velocity_in_site_m_s * time_s + acceleration_m_s2 * (0.5 * time_s * time_s)
    }

    /// Point of the ground plane in a direction of the site frame, its angle off nadir clamped to the ground prior's
    /// largest; `None` from below the plane.
    pub fn ground_point_in_site_m(&self, direction_in_site: &Vector3<f64>) -> Option<Vector3<f64>> {
        if self.lander_in_site_m.z <= 0.0 {
            return None;
        }
        let nadir = -Vector3::z();
        let off_nadir_rad = nadir.angle(direction_in_site);
        let limit_rad = self.ground.largest_off_nadir_rad;
        let direction = if off_nadir_rad > limit_rad {
            let axis = Unit::try_new(nadir.cross(direction_in_site), 1e-12).unwrap_or(Vector3::x_axis());
            Rotation3::from_axis_angle(&axis, limit_rad) * nadir
        } else {
            *direction_in_site
        };
        Some(self.lander_in_site_m + direction * (-self.lander_in_site_m.z / direction.z))
    }
}
