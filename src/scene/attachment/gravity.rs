//! A turning small body: gravity and the apparent forces of a frame that turns with it.

use crate::settings::{OutOfRange, limits};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The small body under the site.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct BodyConfig {
    /// Gravitational parameter in m³/s², 0 to 1e15 (default 5).
    pub gm_m3_s2: f64,
    /// Distance of the site from the body's centre in m, 1 to 1e8 (default 250).
    pub radius_m: f64,
    /// Period of the body's turn in h, 0.001 to 1e6 (default 4.3).
    pub spin_period_h: f64,
    /// Latitude of the site in degrees north, -90 to 90 (default 30).
    pub latitude_deg: f64,
}

impl Default for BodyConfig {
    fn default() -> Self {
        BodyConfig { gm_m3_s2: 5.0, radius_m: 250.0, spin_period_h: 4.3, latitude_deg: 30.0 }
    }
}

impl BodyConfig {
    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::within("gm_m3_s2", self.gm_m3_s2, 0.0, 1e15)?;
        limits::within("radius_m", self.radius_m, 1.0, 1e8)?;
        limits::within("spin_period_h", self.spin_period_h, 1e-3, 1e6)?;
        limits::within("latitude_deg", self.latitude_deg, -90.0, 90.0)
    }
}

/// The body as the site sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TurningBody {
    gm_m3_s2: f64,
    radius_m: f64,
    /// Angular rate of the body, hence of the site, in the site frame, rad/s.
    pub rate_in_site_rad_s: Vector3<f64>,
}

impl TurningBody {
    /// The body of a configuration. The spin axis lies in the plane of north and up, at the latitude from north.
    pub fn new(config: &BodyConfig) -> Self {
        let rate_rad_s = std::f64::consts::TAU / (config.spin_period_h * 3600.0);
        let latitude = config.latitude_deg.to_radians();
        TurningBody {
            gm_m3_s2: config.gm_m3_s2,
            radius_m: config.radius_m,
            rate_in_site_rad_s: Vector3::new(0.0, latitude.cos(), latitude.sin()) * rate_rad_s,
        }
    }

    /// Acceleration in the site frame of what no force but gravity acts on, m/s²:
    /// `g = -GM ρ/|ρ|³ - 2 ω × v - ω × (ω × ρ)` with `ρ = p + (0, 0, R)`.
    pub fn free_acceleration_m_s2(&self, position_m: &Vector3<f64>, velocity_m_s: &Vector3<f64>) -> Vector3<f64> {
        let (omega, rho) = (self.rate_in_site_rad_s, position_m + Vector3::z() * self.radius_m);
        -rho * (self.gm_m3_s2 / rho.norm().powi(3)) - omega.cross(velocity_m_s) * 2.0 - omega.cross(&omega.cross(&rho))
    }
}
