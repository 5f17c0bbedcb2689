//! What an ideal integrating inertial measurement unit reports of any motion.

use crate::dataset::ImuSample;
use crate::geometry::so3;
use nalgebra::{UnitQuaternion, Vector3};

/// A motion as an inertial measurement unit on board senses it.
pub trait SensedMotion {
    /// Rotation against the stars from one time to another: takes axes of the later attitude to those of the earlier.
    fn turn(&self, from_s: f64, to_s: f64) -> UnitQuaternion<f64>;
    /// Specific force in the unit's axes, m/s².
    fn specific_force_m_s2(&self, t_s: f64) -> Vector3<f64>;
}

/// Samples without noise up to `end_ns`, the first one interval after t = 0. The rate is the rotation vector of an interval
/// over its length; the specific force is the mean over the interval in the turning axes (Gauss's three-point rule). A
/// strap-down integration that applies the specific force in the attitude of the middle of the interval closes on the
/// true motion; one that applies it in the attitude of its beginning does not: it makes an error of half an interval's
/// turn.
pub fn ideal_samples(motion: &impl SensedMotion, interval_ns: i64, end_ns: i64) -> Vec<ImuSample> {
    let dt_s = interval_ns as f64 * 1e-9;
    let sample = |t_ns: i64| {
        let middle_s = t_ns as f64 * 1e-9 - 0.5 * dt_s;
        let turn = motion.turn(middle_s - 0.5 * dt_s, middle_s + 0.5 * dt_s);
        let node_s = 0.5 * dt_s * 0.6_f64.sqrt();
        let outer = motion.specific_force_m_s2(middle_s - node_s) + motion.specific_force_m_s2(middle_s + node_s);
        let mean = (outer * 5.0 + motion.specific_force_m_s2(middle_s) * 8.0) / 18.0;
        ImuSample { t_ns, rate_in_lander_rad_s: so3::log(&turn) / dt_s, specific_force_in_lander_m_s2: mean }
    };
    (1..=end_ns / interval_ns).map(|index| sample(index * interval_ns)).collect()
}
