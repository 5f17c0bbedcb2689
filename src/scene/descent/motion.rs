//! Motion of a lander that points its thrust: pose, velocity, specific force and angular rate from one path.

use super::guidance::PolynomialGuidance;
use crate::dataset::truth::LanderState;
use crate::scene::ideal::SensedMotion;
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

/// A lander on its path. Its z axis points along the thrust and its yaw is 0: the attitude is a pitch θ about y after a
/// roll φ about x, `site_from_lander = R_y(θ) R_x(φ)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DescentMotion {
    path: PolynomialGuidance,
}

impl DescentMotion {
    /// Motion along a path whose thrust always points upward.
    pub fn new(path: PolynomialGuidance) -> Self {
        DescentMotion { path }
    }

    /// The path.
    pub fn path(&self) -> &PolynomialGuidance {
        &self.path
    }

    /// Attitude of the lander. From z = (cos φ sin θ, -sin φ, cos φ cos θ) along the specific force f:
    /// θ = atan2(f_x, f_z), φ = atan2(-f_y, √(f_x² + f_z²)).
    pub fn site_from_lander(&self, t_s: f64) -> UnitQuaternion<f64> {
        let f = self.path.specific_force_in_site_m_s2(t_s);
        let (pitch, roll) = (f.x.atan2(f.z), (-f.y).atan2(f.x.hypot(f.z)));
        UnitQuaternion::from_axis_angle(&Vector3::y_axis(), pitch)
            * UnitQuaternion::from_axis_angle(&Vector3::x_axis(), roll)
    }

    /// Specific force in lander axes, m/s².
    pub fn specific_force_in_lander_m_s2(&self, t_s: f64) -> Vector3<f64> {
        self.site_from_lander(t_s).inverse() * self.path.specific_force_in_site_m_s2(t_s)
    }

    /// Angular rate in lander axes, rad/s: (φ̇, θ̇ cos φ, -θ̇ sin φ), with the angles' rates from the jerk.
    pub fn rate_in_lander_rad_s(&self, t_s: f64) -> Vector3<f64> {
        let f = self.path.specific_force_in_site_m_s2(t_s);
        let j = self.path.jerk_in_site_m_s3(t_s);
        let h = f.x.hypot(f.z);
        let h_rate = (f.x * j.x + f.z * j.z) / h;
        let pitch_rate = (j.x * f.z - f.x * j.z) / (h * h);
        let roll_rate = (f.y * h_rate - j.y * h) / f.norm_squared();
        let (sin_roll, cos_roll) = (-f.y / f.norm(), h / f.norm());
        Vector3::new(roll_rate, pitch_rate * cos_roll, -pitch_rate * sin_roll)
    }

    /// True state; biases are 0.
    pub fn state(&self, t_ns: i64) -> LanderState {
        let t_s = t_ns as f64 * 1e-9;
        let position = Translation3::from(self.path.position_in_site_m(t_s));
        LanderState {
            t_ns,
            site_from_lander: Isometry3::from_parts(position, self.site_from_lander(t_s)),
            lander_velocity_in_site_m_s: self.path.velocity_in_site_m_s(t_s),
            gyro_bias_rad_s: Vector3::zeros(),
            accelerometer_bias_m_s2: Vector3::zeros(),
        }
    }
}

impl SensedMotion for DescentMotion {
    fn turn(&self, from_s: f64, to_s: f64) -> UnitQuaternion<f64> {
        self.site_from_lander(from_s).inverse() * self.site_from_lander(to_s)
    }

    fn specific_force_m_s2(&self, t_s: f64) -> Vector3<f64> {
        self.specific_force_in_lander_m_s2(t_s)
    }
}
