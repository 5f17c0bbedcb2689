//! The paper's error coordinates: r̃, ṽ and p̃ in site axes, δθ in lander axes with C = exp(-δθ×) Ĉ (Li et al. 2023,
//! equation (5)). C is `lander_from_site`, the paper's C(q).

use super::coordinates::{LandmarkJacobians, Transition};
use super::imu::ImuIncrement;
use super::measurement::BearingObservation;
use super::state::{ATTITUDE, DescentState, LANDMARKS, POSITION, UnknownLandmark, VELOCITY};
use crate::geometry::so3::{exp, hat};
use nalgebra::{DMatrix, DVector, Matrix3, SMatrix, Vector3};

/// r⁺ = r̂ + r̃, v⁺ = v̂ + ṽ, C⁺ = exp(-δθ×) Ĉ, p⁺ = p̂ + p̃.
pub(super) fn retract(state: &DescentState, error: &DVector<f64>) -> DescentState {
    let part = |start: usize| error.fixed_rows::<3>(start).into_owned();
    let landmarks = state
        .landmarks
        .iter()
        .enumerate()
        .map(|(k, l)| UnknownLandmark { position_in_site_m: l.position_in_site_m + part(LANDMARKS + 3 * k), ..*l });
    DescentState {
        lander_in_site_m: state.lander_in_site_m + part(POSITION),
        lander_velocity_in_site_m_s: state.lander_velocity_in_site_m_s + part(VELOCITY),
        lander_from_site: exp(&-part(ATTITUDE)) * state.lander_from_site,
        landmarks: landmarks.collect(),
    }
}

/// Equations (6) to (10) with the signs of g that follow from equation (2): Φ13 = [r_i - r_j + v_i T + ½ g T²]× C_iᵀ,
/// Φ23 = [v_i - v_j + g T]× C_iᵀ, Φ33 = C_j C_iᵀ.
pub(super) fn transition(
    before: &DescentState,
    after: &DescentState,
    increment: &ImuIncrement,
    gravity_in_site_m_s2: &Vector3<f64>,
) -> Transition {
    let (n, t, g) = (before.error_size(), increment.duration_s, gravity_in_site_m_s2);
    let site_from_before = before.lander_from_site.inverse().to_rotation_matrix().into_inner();
    let (r_i, r_j) = (before.lander_in_site_m, after.lander_in_site_m);
    let (v_i, v_j) = (before.lander_velocity_in_site_m_s, after.lander_velocity_in_site_m_s);
    let mut phi = DMatrix::identity(n, n);
    let mut set = |row: usize, column: usize, block: Matrix3<f64>| {
        phi.fixed_view_mut::<3, 3>(row, column).copy_from(&block);
    };
    set(POSITION, VELOCITY, Matrix3::identity() * t);
    set(POSITION, ATTITUDE, hat(&(r_i - r_j + v_i * t + g * (0.5 * t * t))) * site_from_before);
    set(VELOCITY, ATTITUDE, hat(&(v_i - v_j + g * t)) * site_from_before);
    set(ATTITUDE, ATTITUDE, increment.after_from_before());
    let mut by_noise = DMatrix::zeros(n, 9);
    by_noise.fixed_view_mut::<3, 3>(ATTITUDE, 0).copy_from(&Matrix3::identity());
    by_noise.fixed_view_mut::<3, 3>(VELOCITY, 3).copy_from(&site_from_before);
    by_noise.fixed_view_mut::<3, 3>(POSITION, 6).copy_from(&site_from_before);
    Transition { by_state: phi, by_noise }
}

/// C (p - r): -C for the position, C [ρ×] Cᵀ for the attitude, C for an unknown landmark, ρ = p - r (equations (15) to
/// (18) before the normalisation).
pub(super) fn relative_jacobian(state: &DescentState, landmark: Option<usize>) -> DMatrix<f64> {
    let c = state.lander_from_site.to_rotation_matrix().into_inner();
    let position = landmark.map_or(Vector3::zeros(), |k| state.landmarks[k].position_in_site_m);
    let mut j = DMatrix::zeros(3, state.error_size());
    j.fixed_view_mut::<3, 3>(0, POSITION).copy_from(&-c);
    j.fixed_view_mut::<3, 3>(0, ATTITUDE).copy_from(&(c * hat(&(position - state.lander_in_site_m)) * c.transpose()));
    if let Some(k) = landmark {
        j.fixed_view_mut::<3, 3>(0, LANDMARKS + 3 * k).copy_from(&c);
    }
    j
}

/// p = r + Cᵀ (c + d z): p̃ = E (r̃ - Ĉᵀ[(c + d z)×] δθ + d Ĉᵀ z̃) + (u/u_z) h̃, E = I - u e_zᵀ/u_z, u = Ĉᵀ z.
pub(super) fn landmark_on_ground(
    state: &DescentState,
    bearing: &BearingObservation,
    camera_in_lander_m: &Vector3<f64>,
    height_m: f64,
) -> Option<LandmarkJacobians> {
    let z = bearing.direction_in_lander.into_inner();
    let (position_in_site_m, depth_m) = super::measurement::ground_point(state, &z, camera_in_lander_m, height_m)?;
    let site_from_lander = state.lander_from_site.inverse().to_rotation_matrix().into_inner();
    let u = site_from_lander * z;
    let along_ground = Matrix3::identity() - u * Vector3::z().transpose() / u.z;
    let arm_m = camera_in_lander_m + z * depth_m;
    let mut by_state = DMatrix::zeros(3, state.error_size());
    by_state.fixed_view_mut::<3, 3>(0, POSITION).copy_from(&along_ground);
    by_state.fixed_view_mut::<3, 3>(0, ATTITUDE).copy_from(&(-along_ground * site_from_lander * hat(&arm_m)));
    Some(LandmarkJacobians {
        position_in_site_m,
        by_state,
        by_bearing: along_ground * site_from_lander * depth_m,
        by_height: u / u.z,
    })
}

/// ψ = Ĉᵀ δθ.
pub(super) fn site_jacobian(state: &DescentState) -> SMatrix<f64, 9, 9> {
    let mut j = SMatrix::<f64, 9, 9>::identity();
    let site_from_lander = state.lander_from_site.inverse().to_rotation_matrix().into_inner();
    j.fixed_view_mut::<3, 3>(ATTITUDE, ATTITUDE).copy_from(&site_from_lander);
    j
}
