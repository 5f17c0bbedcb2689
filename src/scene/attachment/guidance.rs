//! Guidance of the formation's centre: an acceleration that is quadratic in the time to go, as in Apollo's descents.

use crate::settings::{OutOfRange, limits};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Boundary conditions of an approach that ends at rest above the site.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ApproachConfig {
    /// Time from start to end in s, 1 to 1e6 (default 1800).
    pub duration_s: f64,
    /// Position of the formation's centre at t = 0 in the site frame, m (default 10, 10, 800).
    pub initial_position_m: [f64; 3],
    /// Velocity at t = 0 in the site frame, m/s (default -0.02, 0.01, -0.5).
    pub initial_velocity_m_s: [f64; 3],
    /// Position at the end in the site frame, m (default 0, 0, 30).
    pub final_position_m: [f64; 3],
    /// Acceleration at the end in the site frame, m/s² (default 0, 0, 0).
    pub final_acceleration_m_s2: [f64; 3],
}

impl Default for ApproachConfig {
    fn default() -> Self {
        ApproachConfig {
            duration_s: 1800.0,
            initial_position_m: [10.0, 10.0, 800.0],
            initial_velocity_m_s: [-0.02, 0.01, -0.5],
            final_position_m: [0.0, 0.0, 30.0],
            final_acceleration_m_s2: [0.0; 3],
        }
    }
}

impl ApproachConfig {
    /// Checks every setting's range, and that the centre stays above the site.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::within("duration_s", self.duration_s, 1.0, 1e6)?;
        limits::finite("initial_position_m", &self.initial_position_m)?;
        limits::finite("initial_velocity_m_s", &self.initial_velocity_m_s)?;
        limits::finite("final_position_m", &self.final_position_m)?;
        limits::finite("final_acceleration_m_s2", &self.final_acceleration_m_s2)?;
        let path = ApolloGuidance::new(self);
        for step in 0..=1000 {
            let t_s = self.duration_s * f64::from(step) / 1000.0;
            if path.position_in_site_m(t_s).z <= 0.0 {
                let cure = format!("the path meets the ground at t = {t_s:.1} s: change the boundary conditions");
                return Err(OutOfRange::new("duration_s", self.duration_s, cure));
            }
        }
        Ok(())
    }
}

/// The path of the formation's centre: `a = a_f + C₁ s + C₂ s²` with the time to go `s = T - t`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ApolloGuidance {
    duration_s: f64,
    final_position_m: Vector3<f64>,
    final_acceleration_m_s2: Vector3<f64>,
    linear_m_s3: Vector3<f64>,
    quadratic_m_s4: Vector3<f64>,
}

impl ApolloGuidance {
    /// Path through the boundary conditions. Integrated backwards from rest at the end, `v = -(a_f s + C₁ s²/2 + C₂ s³/3)`
    /// and `p = p_f + a_f s²/2 + C₁ s³/6 + C₂ s⁴/12`; both hold at `s = T`.
    pub fn new(config: &ApproachConfig) -> Self {
        let duration = config.duration_s;
        let final_position_m = Vector3::from(config.final_position_m);
        let final_acceleration_m_s2 = Vector3::from(config.final_acceleration_m_s2);
        let end = final_acceleration_m_s2 * duration * duration;
        // With A = C₁ T³ and B = C₂ T⁴: A/6 + B/12 = place and A/2 + B/3 = speed.
        let place = Vector3::from(config.initial_position_m) - final_position_m - end * 0.5;
        let speed = -Vector3::from(config.initial_velocity_m_s) * duration - end;
        let b = (speed - place * 3.0) * 12.0;
        let a = speed * 2.0 - b * (2.0 / 3.0);
        ApolloGuidance {
            duration_s: duration,
            final_position_m,
            final_acceleration_m_s2,
            linear_m_s3: a / duration.powi(3),
            quadratic_m_s4: b / duration.powi(4),
        }
    }

    /// Position of the centre in the site frame, m.
    pub fn position_in_site_m(&self, t_s: f64) -> Vector3<f64> {
        let s = self.duration_s - t_s;
        self.final_position_m
            + (self.final_acceleration_m_s2 / 2.0 + self.linear_m_s3 * (s / 6.0) + self.quadratic_m_s4 * (s * s / 12.0))
                * (s * s)
    }

    /// Velocity of the centre in the site frame, m/s.
    pub fn velocity_in_site_m_s(&self, t_s: f64) -> Vector3<f64> {
        let s = self.duration_s - t_s;
        -(self.final_acceleration_m_s2 + self.linear_m_s3 * (s / 2.0) + self.quadratic_m_s4 * (s * s / 3.0)) * s
    }

    /// Acceleration of the centre in the site frame, as seen there, m/s².
    pub fn acceleration_in_site_m_s2(&self, t_s: f64) -> Vector3<f64> {
        let s = self.duration_s - t_s;
        self.final_acceleration_m_s2 + self.linear_m_s3 * s + self.quadratic_m_s4 * (s * s)
    }
}
