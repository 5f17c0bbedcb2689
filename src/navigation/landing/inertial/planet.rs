//! The planet that the site frame is fixed to.

use nalgebra::{UnitQuaternion, Vector3};

use crate::geometry::so3::exp;

/// Gravity and rotation of the site.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Planet {
    /// Gravity at the site, the centrifugal part included, site frame, m/s².
    pub gravity_in_site_m_s2: Vector3<f64>,
    /// Rotation of the site in inertial space, site axes, rad/s; 0 for a site at rest, as the paper has it.
    pub rate_in_site_rad_s: Vector3<f64>,
}

impl Planet {
    /// Whether it turns.
    pub fn turns(&self) -> bool {
        self.rate_in_site_rad_s != Vector3::zeros()
    }

    /// `site_before_from_site_after`: exp(ω T), the turn of the site's axes in a time.
    pub(in crate::navigation::landing) fn before_from_after(&self, time_s: f64) -> UnitQuaternion<f64> {
        exp(&(self.rate_in_site_rad_s * time_s))
    }

    /// Mean gravity over a time, in the site's axes at its start: the planet turns it by ω T on the way.
    pub(in crate::navigation::landing) fn mean_gravity_m_s2(&self, time_s: f64) -> Vector3<f64> {
        if !self.turns() {
            return self.gravity_in_site_m_s2;
        }
        self.before_from_after(0.5 * time_s) * self.gravity_in_site_m_s2
    }
}
