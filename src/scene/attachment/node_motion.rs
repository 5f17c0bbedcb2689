//! Motion of one spacecraft of the formation.

use super::gravity::TurningBody;
use super::guidance::ApolloGuidance;
use super::link::Sinusoids;
use crate::dataset::truth::LanderState;
use crate::geometry::so3;
use crate::scene::ideal::SensedMotion;
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

/// A spacecraft that keeps its place in the formation but for its vibration. Without vibration its axes are the site's.
#[derive(Debug, Clone, PartialEq)]
pub struct NodeMotion {
    /// The path of the formation's centre.
    pub center: ApolloGuidance,
    /// Place in the formation, m.
    pub place_m: Vector3<f64>,
    /// Vibration about the place.
    pub vibration: Sinusoids,
    /// The body below.
    pub body: TurningBody,
}

impl NodeMotion {
    /// Attitude in the site frame.
    pub fn site_from_node(&self, t_s: f64) -> UnitQuaternion<f64> {
        so3::exp(&self.rotation_vector(0, t_s))
    }

    /// Position in the site frame, m.
    pub fn position_in_site_m(&self, t_s: f64) -> Vector3<f64> {
        self.center.position_in_site_m(t_s) + self.place_m + self.displacement(0, t_s)
    }

    /// Velocity in the site frame, m/s.
    pub fn velocity_in_site_m_s(&self, t_s: f64) -> Vector3<f64> {
        self.center.velocity_in_site_m_s(t_s) + self.displacement(1, t_s)
    }

    /// Specific force in node axes, m/s²: acceleration in the site frame less what gravity and the frame's turn explain.
    pub fn specific_force_in_node_m_s2(&self, t_s: f64) -> Vector3<f64> {
        let acceleration = self.center.acceleration_in_site_m_s2(t_s) + self.displacement(2, t_s);
        let free = self.body.free_acceleration_m_s2(&self.position_in_site_m(t_s), &self.velocity_in_site_m_s(t_s));
        self.site_from_node(t_s).inverse() * (acceleration - free)
    }

    /// Angular rate against the stars in node axes, rad/s.
    pub fn rate_in_node_rad_s(&self, t_s: f64) -> Vector3<f64> {
        let phi = self.rotation_vector(0, t_s);
        self.site_from_node(t_s).inverse() * self.body.rate_in_site_rad_s
            + so3::right_jacobian(&phi) * self.rotation_vector(1, t_s)
    }

    /// True state; biases are 0.
    pub fn state(&self, t_ns: i64) -> LanderState {
        let t_s = t_ns as f64 * 1e-9;
        let position = Translation3::from(self.position_in_site_m(t_s));
        LanderState {
            t_ns,
            site_from_lander: Isometry3::from_parts(position, self.site_from_node(t_s)),
            lander_velocity_in_site_m_s: self.velocity_in_site_m_s(t_s),
            gyro_bias_rad_s: Vector3::zeros(),
            accelerometer_bias_m_s2: Vector3::zeros(),
        }
    }

    fn displacement(&self, order: u32, t_s: f64) -> Vector3<f64> {
        self.vibration.derivative(order, t_s).fixed_rows::<3>(0).into_owned()
    }

    fn rotation_vector(&self, order: u32, t_s: f64) -> Vector3<f64> {
        self.vibration.derivative(order, t_s).fixed_rows::<3>(3).into_owned()
    }
}

impl SensedMotion for NodeMotion {
    fn turn(&self, from_s: f64, to_s: f64) -> UnitQuaternion<f64> {
        let turn_of_site = so3::exp(&(self.body.rate_in_site_rad_s * (to_s - from_s)));
        self.site_from_node(from_s).inverse() * turn_of_site * self.site_from_node(to_s)
    }

    fn specific_force_m_s2(&self, t_s: f64) -> Vector3<f64> {
        self.specific_force_in_node_m_s2(t_s)
    }
}
