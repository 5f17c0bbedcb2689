//! The truth between its samples, by cubic Hermite interpolation that uses the true rates.

use crate::dataset::truth::{AsteroidState, LanderState};
use crate::geometry::so3::{exp, left_jacobian, left_jacobian_inverse, log};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

/// Position of a time within sorted samples: the sample before it, and the share of the way to the next (0 at a sample
/// itself); `None` outside.
fn bracket(times: impl Fn(usize) -> i64, count: usize, t_ns: i64) -> Option<(usize, f64)> {
    if count == 0 || t_ns < times(0) || t_ns > times(count - 1) {
        return None;
    }
    let (mut low, mut high) = (0, count);
    while high - low > 1 {
        let middle = (low + high) / 2;
        if times(middle) <= t_ns {
            low = middle;
        } else {
            high = middle;
        }
    }
    if times(low) == t_ns {
        return Some((low, 0.0));
    }
    Some((low, (t_ns - times(low)) as f64 / (times(low + 1) - times(low)) as f64))
}

/// Value and derivative (per unit of `s`) at `s` of the cubic from `a` to `b` with end derivatives `da`, `db`.
fn hermite(s: f64, ends: [Vector3<f64>; 2], slopes: [Vector3<f64>; 2]) -> (Vector3<f64>, Vector3<f64>) {
    let ([a, b], [da, db]) = (ends, slopes);
    let (s2, s3) = (s * s, s * s * s);
    let value = a * (2.0 * s3 - 3.0 * s2 + 1.0) + da * (s3 - 2.0 * s2 + s) + b * (3.0 * s2 - 2.0 * s3) + db * (s3 - s2);
    let slope = (b - a) * (6.0 * (s - s2)) + da * (3.0 * s2 - 4.0 * s + 1.0) + db * (3.0 * s2 - 2.0 * s);
    (value, slope)
}

/// True state of the lander at a time: position and velocity by the cubic through positions and velocities, attitude
/// along the shortest arc; biases of the sample before. `None` outside the samples.
pub fn lander_state_at(states: &[LanderState], t_ns: i64) -> Option<LanderState> {
    let (index, s) = bracket(|k| states[k].t_ns, states.len(), t_ns)?;
    let a = &states[index];
    if s == 0.0 {
        return Some(*a);
    }
    let b = &states[index + 1];
    let dt_s = (b.t_ns - a.t_ns) as f64 * 1e-9;
    let ends = [a.site_from_lander.translation.vector, b.site_from_lander.translation.vector];
    let slopes = [a.lander_velocity_in_site_m_s * dt_s, b.lander_velocity_in_site_m_s * dt_s];
    let (position, slope) = hermite(s, ends, slopes);
    let (qa, qb) = (a.site_from_lander.rotation, b.site_from_lander.rotation);
    let rotation = qa * exp(&(log(&(qa.inverse() * qb)) * s));
    Some(LanderState {
        t_ns,
        site_from_lander: Isometry3::from_parts(Translation3::from(position), rotation),
        lander_velocity_in_site_m_s: slope / dt_s,
        ..*a
    })
}

/// True attitude and rate of the body at a time; `None` outside the samples.
///
/// With `A = asteroid_from_inertial = exp(phi) A_before` and `Ȧ = -[ω×] A`, `phi` obeys `φ̇ = -J_l⁻¹(phi) ω`: the cubic
/// through `phi` and its derivative at both samples.
pub fn asteroid_state_at(states: &[AsteroidState], t_ns: i64) -> Option<AsteroidState> {
    let (index, s) = bracket(|k| states[k].t_ns, states.len(), t_ns)?;
    let a = &states[index];
    if s == 0.0 {
        return Some(*a);
    }
    let b = &states[index + 1];
    let dt_s = (b.t_ns - a.t_ns) as f64 * 1e-9;
    let turn = log(&(b.asteroid_from_inertial * a.asteroid_from_inertial.inverse()));
    let slope = |phi: &Vector3<f64>, rate: &Vector3<f64>| left_jacobian_inverse(phi) * rate * -dt_s;
    let slopes = [slope(&Vector3::zeros(), &a.rate_in_asteroid_rad_s), slope(&turn, &b.rate_in_asteroid_rad_s)];
    let (phi, phi_slope) = hermite(s, [Vector3::zeros(), turn], slopes);
    let asteroid_from_inertial: UnitQuaternion<f64> = exp(&phi) * a.asteroid_from_inertial;
    let rate_in_asteroid_rad_s = left_jacobian(&phi) * phi_slope / -dt_s;
    Some(AsteroidState { t_ns, asteroid_from_inertial, rate_in_asteroid_rad_s })
}
