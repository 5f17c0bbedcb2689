//! Prediction by the IMU.

use super::covariance::propagate;
use crate::navigation::landing::error_state::{Core, DescentEstimate, DescentState, FilterKind};
use crate::navigation::landing::inertial::{ImuIncrement, Planet};

/// The estimate after an increment: equations (1), (2) and (6) of Li et al. 2023, integrated between two images.
pub fn predict(
    estimate: DescentEstimate,
    increment: &ImuIncrement,
    planet: &Planet,
    kind: FilterKind,
) -> DescentEstimate {
    let DescentEstimate { state: before, mut covariance } = estimate;
    let core = Core::of(&before);
    let state = moved(before, increment, planet);
    let transition = kind.transition(&core, &state, increment, planet);
    propagate(&mut covariance, &transition, increment);
    DescentEstimate { state, covariance }
}

/// With u = v + ω×r, the velocity in axes that do not turn, and E = exp(ω T): r' = r_i + u_i T + ½ g T² + C_iᵀ Δp,
/// u' = u_i + g T + C_iᵀ Δv, then r_j = Eᵀ r', v_j = Eᵀ u' - ω×r_j, C_j = M C_i E. For ω = 0 these are the paper's.
fn moved(state: DescentState, increment: &ImuIncrement, planet: &Planet) -> DescentState {
    let t = increment.duration_s;
    let (g, w) = (planet.mean_gravity_m_s2(t), planet.rate_in_site_rad_s);
    let site_from_lander = state.lander_from_site.inverse();
    let r = state.lander_in_site_m;
    let u = state.lander_velocity_in_site_m_s + w.cross(&r);
    let position_m = r + u * t + g * (0.5 * t * t) + site_from_lander * increment.position_in_before_m;
    let velocity_m_s = u + g * t + site_from_lander * increment.velocity_in_before_m_s;
    let turn = planet.before_from_after(t);
    let lander_in_site_m = turn.inverse_transform_vector(&position_m);
    DescentState {
        lander_in_site_m,
        lander_velocity_in_site_m_s: turn.inverse_transform_vector(&velocity_m_s) - w.cross(&lander_in_site_m),
        lander_from_site: increment.before_from_after.inverse() * state.lander_from_site * turn,
        ..state
    }
}
