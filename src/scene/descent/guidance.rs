//! Polynomial descent guidance: the position is a polynomial of time through given boundary conditions.

use crate::settings::{OutOfRange, limits};
use nalgebra::{Matrix3, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Degree of the guidance polynomial.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub enum GuidanceProfile {
    /// Fourth degree: the initial acceleration, hence the initial attitude, follows from the rest.
    #[default]
    Quartic,
    /// Fifth degree through a given initial acceleration.
    Quintic {
        /// Acceleration at t = 0 in the site frame, m/s².
        initial_acceleration_m_s2: [f64; 3],
    },
}

/// Boundary conditions of a descent that ends at rest at the site's origin. The defaults resemble Tianwen-1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct GuidanceConfig {
    /// Time from start to touchdown in s, 1 to 10000 (default 198).
    pub duration_s: f64,
    /// Position at t = 0 in the site frame, m (default 3300, 5870, 6570).
    pub initial_position_m: [f64; 3],
    /// Velocity at t = 0 in the site frame, m/s (default -56, -66, -90).
    pub initial_velocity_m_s: [f64; 3],
    /// Acceleration at touchdown in the site frame, m/s² (default 0, 0, 0.7).
    pub final_acceleration_m_s2: [f64; 3],
    /// Gravity, downward, in m/s², 0 to 100 (default 3.711).
    pub gravity_m_s2: f64,
    /// Degree of the polynomial (default `quartic`).
    pub profile: GuidanceProfile,
}

impl Default for GuidanceConfig {
    fn default() -> Self {
        GuidanceConfig {
            duration_s: 198.0,
            initial_position_m: [3300.0, 5870.0, 6570.0],
            initial_velocity_m_s: [-56.0, -66.0, -90.0],
            final_acceleration_m_s2: [0.0, 0.0, 0.7],
            gravity_m_s2: 3.711,
            profile: GuidanceProfile::Quartic,
        }
    }
}

impl GuidanceConfig {
    /// Gravity in the site frame, m/s².
    pub fn gravity_in_site_m_s2(&self) -> Vector3<f64> {
        Vector3::new(0.0, 0.0, -self.gravity_m_s2)
    }

    /// Checks every setting's range, and that the lander stays above the site with its thrust upward.
    ///
    /// # Errors
    /// Names the key at fault.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::within("duration_s", self.duration_s, 1.0, 10_000.0)?;
        limits::finite("initial_position_m", &self.initial_position_m)?;
        limits::positive("initial_position_m", self.initial_position_m[2])?;
        limits::finite("initial_velocity_m_s", &self.initial_velocity_m_s)?;
        limits::finite("final_acceleration_m_s2", &self.final_acceleration_m_s2)?;
        limits::within("gravity_m_s2", self.gravity_m_s2, 0.0, 100.0)?;
        if let GuidanceProfile::Quintic { initial_acceleration_m_s2 } = &self.profile {
            limits::finite("profile.quintic.initial_acceleration_m_s2", initial_acceleration_m_s2)?;
        }
        let path = PolynomialGuidance::new(self);
        for step in 0..2000 {
            let t_s = self.duration_s * f64::from(step) / 2000.0;
            if path.position_in_site_m(t_s).z <= 0.0 {
                let cure = format!("the path meets the ground at t = {t_s:.1} s: change the boundary conditions");
                return Err(OutOfRange::new("duration_s", self.duration_s, cure));
            }
            if path.specific_force_in_site_m_s2(t_s).z <= 0.0 {
                let cure = format!("the thrust points down at t = {t_s:.1} s: change the boundary conditions");
                return Err(OutOfRange::new("duration_s", self.duration_s, cure));
            }
        }
        Ok(())
    }
}

/// A descent's path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PolynomialGuidance {
    /// Coefficients of t⁰ to t⁵ in the site frame, m/sᵏ.
    pub coefficients: [Vector3<f64>; 6],
    /// Time from start to touchdown in s.
    pub duration_s: f64,
    gravity_in_site_m_s2: Vector3<f64>,
}

impl PolynomialGuidance {
    /// Path through the boundary conditions. With u_k = c_k Tᵏ the last three coefficients solve Σ u_k = -(known),
    /// Σ k u_k = -(known), Σ k (k-1) u_k = a_f T² - (known): position, velocity and acceleration at touchdown.
    pub fn new(config: &GuidanceConfig) -> Self {
        let duration = config.duration_s;
        let mut scaled = [Vector3::zeros(); 6];
        scaled[0] = Vector3::from(config.initial_position_m);
        scaled[1] = Vector3::from(config.initial_velocity_m_s) * duration;
        let first_free = match config.profile {
            GuidanceProfile::Quartic => 2,
            GuidanceProfile::Quintic { initial_acceleration_m_s2 } => {
                scaled[2] = Vector3::from(initial_acceleration_m_s2) * (0.5 * duration * duration);
                3
            }
        };
        let powers = Vector3::from_fn(|i, _| (first_free + i) as f64);
        let equations = Matrix3::from_rows(&[
            nalgebra::RowVector3::repeat(1.0),
            powers.transpose(),
            powers.map(|k| k * (k - 1.0)).transpose(),
        ]);
        let inverse = equations.try_inverse().expect("three different powers are independent");
        let end = Vector3::from(config.final_acceleration_m_s2) * duration * duration;
        let known =
            |weight: fn(f64) -> f64| (0..first_free).map(|k| scaled[k] * weight(k as f64)).sum::<Vector3<f64>>();
        let right = Matrix3::from_rows(&[
            -known(|_| 1.0).transpose(),
            -known(|k| k).transpose(),
            (end - known(|k| k * (k - 1.0))).transpose(),
        ]);
        let solution = inverse * right;
        for (i, row) in solution.row_iter().enumerate() {
            scaled[first_free + i] = row.transpose();
        }
        let coefficients = std::array::from_fn(|k| scaled[k] / duration.powi(k as i32));
        PolynomialGuidance { coefficients, duration_s: duration, gravity_in_site_m_s2: config.gravity_in_site_m_s2() }
    }

    /// Position in the site frame, m.
    pub fn position_in_site_m(&self, t_s: f64) -> Vector3<f64> {
        self.derivative(0, t_s)
    }

    /// Velocity in the site frame, m/s.
    pub fn velocity_in_site_m_s(&self, t_s: f64) -> Vector3<f64> {
        self.derivative(1, t_s)
    }

    /// Acceleration less gravity in the site frame, m/s²: what thrust has to provide.
    pub fn specific_force_in_site_m_s2(&self, t_s: f64) -> Vector3<f64> {
        self.derivative(2, t_s) - self.gravity_in_site_m_s2
    }

    /// Derivative of the acceleration in the site frame, m/s³.
    pub fn jerk_in_site_m_s3(&self, t_s: f64) -> Vector3<f64> {
        self.derivative(3, t_s)
    }

    /// Derivative of the position, by Horner's scheme.
    fn derivative(&self, order: usize, t_s: f64) -> Vector3<f64> {
        let falling = |k: usize| (0..order).map(|i| (k - i) as f64).product::<f64>();
        (order..6).rev().fold(Vector3::zeros(), |sum, k| sum * t_s + self.coefficients[k] * falling(k))
    }
}
