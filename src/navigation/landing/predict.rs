//! Prediction by the IMU.

use super::imu::ImuIncrement;
use super::{DescentEstimate, DescentState, FilterKind};
use nalgebra::Vector3;

/// The estimate after an increment: equations (1), (2) and (6) of Li et al. 2023, integrated between two images.
pub fn predict(
    estimate: &DescentEstimate,
    increment: &ImuIncrement,
    gravity_in_site_m_s2: &Vector3<f64>,
    kind: FilterKind,
) -> DescentEstimate {
    let state = moved(&estimate.state, increment, gravity_in_site_m_s2);
    let transition = kind.transition(&estimate.state, &state, increment, gravity_in_site_m_s2);
    let (f, g) = (transition.by_state, transition.by_noise);
    let p = &f * &estimate.covariance * f.transpose() + &g * increment.covariance * g.transpose();
    DescentEstimate { state, covariance: (&p + p.transpose()) * 0.5 }
}

/// r_j = r_i + v_i T + ½ g T² + C_iᵀ Δp, v_j = v_i + g T + C_iᵀ Δv, C_j = M C_i.
fn moved(state: &DescentState, increment: &ImuIncrement, g: &Vector3<f64>) -> DescentState {
    let t = increment.duration_s;
    let site_from_lander = state.lander_from_site.inverse();
    let v = state.lander_velocity_in_site_m_s;
    let fallen_m = v * t + g * (0.5 * t * t);
    DescentState {
        lander_in_site_m: state.lander_in_site_m + fallen_m + site_from_lander * increment.position_in_before_m,
        lander_velocity_in_site_m_s: v + g * t + site_from_lander * increment.velocity_in_before_m_s,
        lander_from_site: increment.before_from_after.inverse() * state.lander_from_site,
        landmarks: state.landmarks.clone(),
    }
}
