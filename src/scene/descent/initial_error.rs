//! What the lander believes at the first image.

use crate::dataset::truth::LanderState;
use crate::dataset::{DesignatedPoint, InitialState};
use crate::geometry::Manifold;
use crate::settings::{OutOfRange, limits};
use crate::stats::random_stream;
use nalgebra::{Isometry3, Matrix2, Translation3, Vector2, Vector3};
use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Errors of the first state, uniform within plus or minus each value on each axis, and of the designated pixel.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct InitialErrorConfig {
    /// Half-range of the position's error in m an axis, 1e-6 to 1e6 (default 1000).
    pub position_m: f64,
    /// Half-range of the velocity's error in m/s an axis, 1e-9 to 10000 (default 10).
    pub velocity_m_s: f64,
    /// Half-range of the attitude's error in degrees an axis of the lander, 1e-9 to 90 (default 2).
    pub attitude_deg: f64,
    /// 1σ of the designated landing point's pixel in px an axis, 1e-6 to 1000 (default 0.1), Gaussian.
    pub designated_sigma_px: f64,
}

impl Default for InitialErrorConfig {
    fn default() -> Self {
        InitialErrorConfig { position_m: 1000.0, velocity_m_s: 10.0, attitude_deg: 2.0, designated_sigma_px: 0.1 }
    }
}

impl InitialErrorConfig {
    /// A first estimate with seeded errors around the truth; 1σ of a uniform error is its half-range over √3.
    pub fn initial_state(&self, truth: &LanderState, seed: u64) -> InitialState {
        let mut random = random_stream(seed, "initial-state", 0);
        let mut uniform = |half_range: f64| {
            let draw: [f64; 3] = std::array::from_fn(|_| random.random_range(-1.0..=1.0));
            Vector3::from(draw) * half_range
        };
        let attitude_rad = self.attitude_deg.to_radians();
        let position_m = truth.site_from_lander.translation.vector + uniform(self.position_m);
        let velocity_m_s = truth.lander_velocity_in_site_m_s + uniform(self.velocity_m_s);
        let attitude = truth.site_from_lander.rotation.plus(&uniform(attitude_rad));
        let root3 = 3.0_f64.sqrt();
        InitialState {
            t_ns: truth.t_ns,
            site_from_lander: Isometry3::from_parts(Translation3::from(position_m), attitude),
            lander_velocity_in_site_m_s: velocity_m_s,
            sigma_position_m: self.position_m / root3,
            sigma_velocity_m_s: self.velocity_m_s / root3,
            sigma_attitude_rad: attitude_rad / root3,
        }
    }

    /// The designated point near its true pixel.
    pub fn designated(&self, t_ns: i64, true_pixel_px: &Vector2<f64>, seed: u64) -> DesignatedPoint {
        let mut random = random_stream(seed, "designated", 0);
        let draw: [f64; 2] = std::array::from_fn(|_| StandardNormal.sample(&mut random));
        DesignatedPoint {
            t_ns,
            pixel_px: true_pixel_px + Vector2::from(draw) * self.designated_sigma_px,
            covariance_px2: Matrix2::identity() * self.designated_sigma_px.powi(2),
        }
    }

    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::within("position_m", self.position_m, 1e-6, 1e6)?;
        limits::within("velocity_m_s", self.velocity_m_s, 1e-9, 1e4)?;
        limits::within("attitude_deg", self.attitude_deg, 1e-9, 90.0)?;
        limits::within("designated_sigma_px", self.designated_sigma_px, 1e-6, 1e3)
    }
}
