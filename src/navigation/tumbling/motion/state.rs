//! Attitude and rate of the small body.

use crate::geometry::Manifold;
use nalgebra::{UnitQuaternion, Vector3, Vector6};

/// Attitude and rate. The inertial axes are the camera's (the camera does not turn), and the asteroid axes are the
/// camera's axes at the first image, so the attitude is the identity there by definition.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpinState {
    /// Attitude (Hamilton).
    pub asteroid_from_inertial: UnitQuaternion<f64>,
    /// Angular rate of the asteroid in asteroid axes, rad/s.
    pub rate_in_asteroid_rad_s: Vector3<f64>,
}

impl Manifold<6> for SpinState {
    /// `d` = (attitude error in **inertial** axes in rad: `truth = estimate * exp(d)`; rate error in asteroid axes, rad/s).
    fn plus(&self, d: &Vector6<f64>) -> Self {
        SpinState {
            asteroid_from_inertial: self.asteroid_from_inertial.plus(&d.fixed_rows::<3>(0).into_owned()),
            rate_in_asteroid_rad_s: self.rate_in_asteroid_rad_s + d.fixed_rows::<3>(3),
        }
    }

    fn minus(&self, other: &Self) -> Vector6<f64> {
        let attitude = self.asteroid_from_inertial.minus(&other.asteroid_from_inertial);
        let rate = self.rate_in_asteroid_rad_s - other.rate_in_asteroid_rad_s;
        Vector6::new(attitude.x, attitude.y, attitude.z, rate.x, rate.y, rate.z)
    }
}
