//! The paper's error coordinates: r̃, ṽ and p̃ in site axes, δθ in lander axes with C = exp(-δθ×) Ĉ (Li et al. 2023,
//! equation (5)). C is `lander_from_site`, the paper's C(q).

use super::jacobian::{RayPoint, RelativeJacobian, part};
use super::state::{ATTITUDE, BIASES, DescentState, POSITION, VELOCITY, WITH_BIASES};
use super::state_core::Core;
use super::transition::{LandmarkTransition, Transition};
use crate::geometry::so3::{exp, hat};
use crate::navigation::landing::inertial::{ImuIncrement, Planet};
use nalgebra::{Matrix3, SMatrix, Vector3};

/// r⁺ = r̂ + r̃, v⁺ = v̂ + ṽ, C⁺ = exp(-δθ×) Ĉ, p⁺ = p̂ + p̃.
pub(super) fn retract(mut state: DescentState, error: &[f64]) -> DescentState {
    state.lander_in_site_m += part(error, POSITION);
    state.lander_velocity_in_site_m_s += part(error, VELOCITY);
    state.lander_from_site = exp(&-part(error, ATTITUDE)) * state.lander_from_site;
    let start = state.own_size();
    for (k, landmark) in state.landmarks.iter_mut().enumerate() {
        landmark.position_in_site_m += part(error, start + 3 * k);
    }
    state
}

type Own = SMatrix<f64, WITH_BIASES, WITH_BIASES>;

/// Equations (6) to (10) with the signs of g that follow from equation (2): Φ13 = [r_i - r_j + v_i T + ½ g T²]× C_iᵀ =
/// -[C_iᵀ Δp]× C_iᵀ, Φ23 = [v_i - v_j + g T]× C_iᵀ = -[C_iᵀ Δv]× C_iᵀ, Φ33 = C_j C_iᵀ. Where the planet turns, this holds
/// for u = v + ω×r in axes that do not turn, and the result is turned into the site's axes.
pub(super) fn transition(before: &Core, after: &DescentState, increment: &ImuIncrement, planet: &Planet) -> Transition {
    let t = increment.duration_s;
    let site_from_before = before.lander_from_site.inverse().to_rotation_matrix().into_inner();
    let moved_m = site_from_before * increment.position_in_before_m;
    let gained_m_s = site_from_before * increment.velocity_in_before_m_s;
    let mut phi = Own::identity();
    let mut set = |row: usize, column: usize, block: Matrix3<f64>| {
        phi.fixed_view_mut::<3, 3>(row, column).copy_from(&block);
    };
    set(POSITION, VELOCITY, Matrix3::identity() * t);
    set(POSITION, ATTITUDE, -hat(&moved_m) * site_from_before);
    set(VELOCITY, ATTITUDE, -hat(&gained_m_s) * site_from_before);
    set(ATTITUDE, ATTITUDE, increment.after_from_before());
    let mut by_noise = SMatrix::<f64, 9, 9>::zeros();
    by_noise.fixed_view_mut::<3, 3>(ATTITUDE, 0).copy_from(&Matrix3::identity());
    by_noise.fixed_view_mut::<3, 3>(VELOCITY, 3).copy_from(&site_from_before);
    by_noise.fixed_view_mut::<3, 3>(POSITION, 6).copy_from(&site_from_before);
    if planet.turns() {
        (phi, by_noise) = turned_with_planet(phi, by_noise, &planet.rate_in_site_rad_s, t);
    }
    let still = LandmarkTransition {
        by_landmark: Matrix3::identity(),
        by_state: SMatrix::zeros(),
        by_rotation_noise: Matrix3::zeros(),
    };
    let landmarks = after.landmarks.iter().map(|_| still).collect();
    Transition { own_size: BIASES, by_state: phi, by_noise, landmarks, couples: planet.turns() }
}

/// ũ = ṽ + ω×r̃ before; r̃ and ũ turned by Eᵀ = exp(-ω T) and ṽ = ũ - ω×r̃ after.
fn turned_with_planet(
    phi: Own,
    by_noise: SMatrix<f64, 9, 9>,
    rate: &Vector3<f64>,
    time_s: f64,
) -> (Own, SMatrix<f64, 9, 9>) {
    let back = exp(&(-rate * time_s)).to_rotation_matrix().into_inner();
    let mut inward = Own::identity();
    inward.fixed_view_mut::<3, 3>(VELOCITY, POSITION).copy_from(&hat(rate));
    let mut outward = Own::identity();
    outward.fixed_view_mut::<3, 3>(POSITION, POSITION).copy_from(&back);
    outward.fixed_view_mut::<3, 3>(VELOCITY, VELOCITY).copy_from(&back);
    outward.fixed_view_mut::<3, 3>(VELOCITY, POSITION).copy_from(&(-hat(rate) * back));
    let own = outward.fixed_view::<BIASES, BIASES>(0, 0).into_owned();
    (outward * phi * inward, own * by_noise)
}

/// C (p - r): -C for the position, C [ρ×] Cᵀ for the attitude, C for a landmark of the state, ρ = p - r (equations (15)
/// to (18) before the normalisation).
pub(super) fn relative_jacobian(
    state: &DescentState,
    point_in_site_m: &Vector3<f64>,
    is_state: bool,
) -> RelativeJacobian {
    let c = state.lander_from_site.to_rotation_matrix().into_inner();
    RelativeJacobian {
        by_position: -c,
        by_attitude: c * hat(&(point_in_site_m - state.lander_in_site_m)) * c.transpose(),
        by_landmark: if is_state { c } else { Matrix3::zeros() },
    }
}

/// p = r + Cᵀ a: p̃ = r̃ - Ĉᵀ[a×] δθ + reach Ĉᵀ z̃, with the arm a in lander axes.
pub(super) fn point_of_arm(state: &DescentState, arm_in_lander_m: &Vector3<f64>, reach_m: f64) -> RayPoint {
    let site_from_lander = state.lander_from_site.inverse().to_rotation_matrix().into_inner();
    RayPoint {
        position_in_site_m: state.lander_in_site_m + site_from_lander * arm_in_lander_m,
        by_position: Matrix3::identity(),
        by_attitude: -site_from_lander * hat(arm_in_lander_m),
        by_bearing: site_from_lander * reach_m,
        by_height: Vector3::zeros(),
    }
}

/// p̃ = E (r̃ - Ĉᵀ[(c + d z)×] δθ + d Ĉᵀ z̃) + (u/u_z) h̃, E = I - u e_zᵀ/u_z, u = Ĉᵀ z.
pub(super) fn kept_on_ground(state: &DescentState, free: RayPoint, direction_in_lander: &Vector3<f64>) -> RayPoint {
    let u = state.lander_from_site.inverse() * direction_in_lander;
    let along_ground = Matrix3::identity() - u * Vector3::z().transpose() / u.z;
    RayPoint {
        by_position: along_ground,
        by_attitude: along_ground * free.by_attitude,
        by_bearing: along_ground * free.by_bearing,
        by_height: u / u.z,
        ..free
    }
}

/// ψ = Ĉᵀ δθ.
pub(super) fn site_jacobian(state: &DescentState) -> SMatrix<f64, 9, 9> {
    let mut j = SMatrix::<f64, 9, 9>::identity();
    let site_from_lander = state.lander_from_site.inverse().to_rotation_matrix().into_inner();
    j.fixed_view_mut::<3, 3>(ATTITUDE, ATTITUDE).copy_from(&site_from_lander);
    j
}
