//! Consistent error coordinates: s̃ = C r - Ĉ r̂, w̃ = C v - Ĉ v̂, l̃ = C p - Ĉ p̂ in lander axes, and ψ in site axes with
//! C = Ĉ exp(-ψ×). C is `lander_from_site`.
//!
//! The bearing of a landmark depends on l - s alone and the motion on gravity alone, so that a turn about the vertical,
//! which nothing observes, is exactly the third component of ψ and stays so.

use super::coordinates::{LandmarkJacobians, Transition};
use super::imu::ImuIncrement;
use super::measurement::BearingObservation;
use super::state::{ATTITUDE, DescentState, LANDMARKS, POSITION, UnknownLandmark, VELOCITY};
use crate::geometry::so3::{exp, hat};
use nalgebra::{DMatrix, DVector, Matrix3, SMatrix, Vector3};

/// C⁺ = Ĉ exp(-ψ×), r⁺ = C⁺ᵀ (Ĉ r̂ + s̃), and the same for velocity and landmarks.
pub(super) fn retract(state: &DescentState, error: &DVector<f64>) -> DescentState {
    let part = |start: usize| error.fixed_rows::<3>(start).into_owned();
    let lander_from_site = state.lander_from_site * exp(&-part(ATTITUDE));
    let moved = |vector: &Vector3<f64>, start: usize| {
        lander_from_site.inverse_transform_vector(&(state.lander_from_site * vector + part(start)))
    };
    let landmarks = state
        .landmarks
        .iter()
        .enumerate()
        .map(|(k, l)| UnknownLandmark { position_in_site_m: moved(&l.position_in_site_m, LANDMARKS + 3 * k), ..*l });
    DescentState {
        lander_in_site_m: moved(&state.lander_in_site_m, POSITION),
        lander_velocity_in_site_m_s: moved(&state.lander_velocity_in_site_m_s, VELOCITY),
        lander_from_site,
        landmarks: landmarks.collect(),
    }
}

/// F = blkdiag(M, M, I, M) [I, T I, ½T² Ĉ[g×]; 0, I, T Ĉ[g×]; …] with M = C_j C_iᵀ; the noise of the rotation turns
/// every vector that is held in lander axes.
pub(super) fn transition(
    before: &DescentState,
    after: &DescentState,
    increment: &ImuIncrement,
    gravity_in_site_m_s2: &Vector3<f64>,
) -> Transition {
    let (n, t) = (before.error_size(), increment.duration_s);
    let m = increment.after_from_before();
    let tilt = m * before.lander_from_site.to_rotation_matrix().into_inner() * hat(gravity_in_site_m_s2);
    let mut f = DMatrix::identity(n, n);
    let mut set = |row: usize, column: usize, block: Matrix3<f64>| {
        f.fixed_view_mut::<3, 3>(row, column).copy_from(&block);
    };
    set(POSITION, POSITION, m);
    set(POSITION, VELOCITY, m * t);
    set(POSITION, ATTITUDE, tilt * (0.5 * t * t));
    set(VELOCITY, VELOCITY, m);
    set(VELOCITY, ATTITUDE, tilt * t);
    (0..before.landmarks.len()).for_each(|k| set(LANDMARKS + 3 * k, LANDMARKS + 3 * k, m));
    Transition { by_state: f, by_noise: noise_jacobian(after, &m) }
}

/// Columns: noise of the rotation (axes of the lander after), of the velocity and of the position (before).
fn noise_jacobian(after: &DescentState, after_from_before: &Matrix3<f64>) -> DMatrix<f64> {
    let c = &after.lander_from_site;
    let mut g = DMatrix::zeros(after.error_size(), 9);
    let mut set = |row: usize, column: usize, block: Matrix3<f64>| {
        g.fixed_view_mut::<3, 3>(row, column).copy_from(&block);
    };
    set(POSITION, 0, hat(&(c * after.lander_in_site_m)));
    set(POSITION, 6, *after_from_before);
    set(VELOCITY, 0, hat(&(c * after.lander_velocity_in_site_m_s)));
    set(VELOCITY, 3, *after_from_before);
    set(ATTITUDE, 0, c.inverse().to_rotation_matrix().into_inner());
    for (k, landmark) in after.landmarks.iter().enumerate() {
        set(LANDMARKS + 3 * k, 0, hat(&(c * landmark.position_in_site_m)));
    }
    g
}

/// l - s: minus the identity for the lander, plus the identity for an unknown landmark.
pub(super) fn relative_jacobian(state: &DescentState, landmark: Option<usize>) -> DMatrix<f64> {
    let mut j = DMatrix::zeros(3, state.error_size());
    j.fixed_view_mut::<3, 3>(0, POSITION).copy_from(&-Matrix3::identity());
    if let Some(k) = landmark {
        j.fixed_view_mut::<3, 3>(0, LANDMARKS + 3 * k).copy_from(&Matrix3::identity());
    }
    j
}

/// l = s + c + d z with d = (h - e_z·Cᵀ(s + c)) / (e_z·Cᵀ z), c the camera and z the bearing in lander axes.
pub(super) fn landmark_on_ground(
    state: &DescentState,
    bearing: &BearingObservation,
    camera_in_lander_m: &Vector3<f64>,
    height_m: f64,
) -> Option<LandmarkJacobians> {
    let z = bearing.direction_in_lander.into_inner();
    let (position_in_site_m, depth_m) = super::measurement::ground_point(state, &z, camera_in_lander_m, height_m)?;
    let up = state.lander_from_site * Vector3::z();
    let over_fall = z / up.dot(&z);
    let along_ground = Matrix3::identity() - over_fall * up.transpose();
    let mut by_state = DMatrix::zeros(3, state.error_size());
    by_state.fixed_view_mut::<3, 3>(0, POSITION).copy_from(&along_ground);
    let turn = position_in_site_m.cross(&Vector3::z());
    by_state.fixed_view_mut::<3, 3>(0, ATTITUDE).copy_from(&(-over_fall * turn.transpose()));
    Some(LandmarkJacobians { position_in_site_m, by_state, by_bearing: along_ground * depth_m, by_height: over_fall })
}

/// r̃ = Ĉᵀ s̃ - r̂×ψ, ṽ = Ĉᵀ w̃ - v̂×ψ.
pub(super) fn site_jacobian(state: &DescentState) -> SMatrix<f64, 9, 9> {
    let site_from_lander = state.lander_from_site.inverse().to_rotation_matrix().into_inner();
    let mut j = SMatrix::<f64, 9, 9>::identity();
    for (start, vector) in [(POSITION, &state.lander_in_site_m), (VELOCITY, &state.lander_velocity_in_site_m_s)] {
        j.fixed_view_mut::<3, 3>(start, start).copy_from(&site_from_lander);
        j.fixed_view_mut::<3, 3>(start, ATTITUDE).copy_from(&-hat(vector));
    }
    j
}

/// What the second order of r = exp(ψ×)(r̂ + e), e = Ĉᵀ s̃, adds to the second moments of r̃ and ṽ: a yaw that is off by ψ
/// bends the error into an arc, ½ ψ² |r| across it. For quadratic forms ½ xᵀ A_i x of a Gaussian x with covariance P it
/// is ½ tr(A_i P A_j P) + ¼ tr(A_i P) tr(A_j P).
pub(super) fn site_second_moment(state: &DescentState, covariance: &SMatrix<f64, 9, 9>) -> SMatrix<f64, 9, 9> {
    let site_from_lander = state.lander_from_site.inverse().to_rotation_matrix().into_inner();
    let mut turn = SMatrix::<f64, 9, 9>::identity();
    turn.fixed_view_mut::<3, 3>(POSITION, POSITION).copy_from(&site_from_lander);
    turn.fixed_view_mut::<3, 3>(VELOCITY, VELOCITY).copy_from(&site_from_lander);
    let p = turn * covariance * turn.transpose();
    let ap: [SMatrix<f64, 9, 9>; 6] = std::array::from_fn(|row| {
        let (start, vector) =
            if row < 3 { (POSITION, &state.lander_in_site_m) } else { (VELOCITY, &state.lander_velocity_in_site_m_s) };
        second_derivative(row % 3, start, vector) * p
    });
    SMatrix::from_fn(|i, j| {
        if i < 6 && j < 6 { 0.5 * (ap[i] * ap[j]).trace() + 0.25 * ap[i].trace() * ap[j].trace() } else { 0.0 }
    })
}

/// A_i of component i of ψ×e + ½ ψ×(ψ×r̂), where e starts at `start`.
fn second_derivative(i: usize, start: usize, vector: &Vector3<f64>) -> SMatrix<f64, 9, 9> {
    let mut a = SMatrix::<f64, 9, 9>::zeros();
    let axis = Vector3::ith(i, 1.0);
    // e_i · (ψ × e) = ψ · (e × e_i) = -ψᵀ [e_i×] e.
    let mixed = -hat(&axis);
    a.fixed_view_mut::<3, 3>(ATTITUDE, start).copy_from(&mixed);
    a.fixed_view_mut::<3, 3>(start, ATTITUDE).copy_from(&mixed.transpose());
    let outer = axis * vector.transpose();
    let bend = (outer + outer.transpose()) * 0.5 - Matrix3::identity() * vector[i];
    a.fixed_view_mut::<3, 3>(ATTITUDE, ATTITUDE).copy_from(&bend);
    a
}
