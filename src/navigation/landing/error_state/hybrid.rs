//! Consistent error coordinates: s̃ = C r - Ĉ r̂, w̃ = C v - Ĉ v̂, l̃ = C p - Ĉ p̂ in lander axes, and ψ in site axes with
//! C = Ĉ exp(-ψ×). C is `lander_from_site`.
//!
//! The bearing of a landmark depends on l - s alone and the motion on gravity alone, so that a turn about the vertical,
//! which nothing observes, is exactly the third component of ψ and stays so.

use super::jacobian::{RayPoint, RelativeJacobian, part};
use super::state::{ATTITUDE, BIASES, DescentState, POSITION, VELOCITY, WITH_BIASES};
use super::state_core::Core;
use super::transition::{LandmarkTransition, Transition};
use crate::geometry::so3::{exp, hat};
use crate::navigation::filter::QuadraticMoments;
use crate::navigation::landing::inertial::{ImuIncrement, Planet};
use crate::stats::symmetric;
use nalgebra::{Matrix3, SMatrix, Vector3};

/// C⁺ = Ĉ exp(-ψ×), r⁺ = C⁺ᵀ (Ĉ r̂ + s̃), and the same for velocity and landmarks.
pub(super) fn retract(mut state: DescentState, error: &[f64]) -> DescentState {
    let before = state.lander_from_site;
    let after = before * exp(&-part(error, ATTITUDE));
    let moved =
        |vector: &Vector3<f64>, start: usize| after.inverse_transform_vector(&(before * vector + part(error, start)));
    state.lander_in_site_m = moved(&state.lander_in_site_m, POSITION);
    state.lander_velocity_in_site_m_s = moved(&state.lander_velocity_in_site_m_s, VELOCITY);
    state.lander_from_site = after;
    let start = state.own_size();
    for (k, landmark) in state.landmarks.iter_mut().enumerate() {
        landmark.position_in_site_m = moved(&landmark.position_in_site_m, start + 3 * k);
    }
    state
}

type Own = SMatrix<f64, WITH_BIASES, WITH_BIASES>;

/// F = blkdiag(M, M, I, M) [I, T I, ½T² Ĉ[g×]; 0, I, T Ĉ[g×]; …] with M = C_j C_iᵀ; the noise of the rotation turns
/// every vector that is held in lander axes. Where the planet turns, this holds for u = v + ω×r and is changed to v.
pub(super) fn transition(before: &Core, after: &DescentState, increment: &ImuIncrement, planet: &Planet) -> Transition {
    let t = increment.duration_s;
    let m = increment.after_from_before();
    let before_c = before.lander_from_site.to_rotation_matrix().into_inner();
    let tilt = m * before_c * hat(&planet.mean_gravity_m_s2(t));
    let mut f = Own::identity();
    let mut set = |row: usize, column: usize, block: Matrix3<f64>| {
        f.fixed_view_mut::<3, 3>(row, column).copy_from(&block);
    };
    set(POSITION, POSITION, m);
    set(POSITION, VELOCITY, m * t);
    set(POSITION, ATTITUDE, tilt * (0.5 * t * t));
    set(VELOCITY, VELOCITY, m);
    set(VELOCITY, ATTITUDE, tilt * t);
    let c = after.lander_from_site.to_rotation_matrix().into_inner();
    let landmarks = after.landmarks.iter().map(|l| LandmarkTransition {
        by_landmark: m,
        by_state: SMatrix::zeros(),
        by_rotation_noise: hat(&(c * l.position_in_site_m)),
    });
    let mut transition = Transition {
        own_size: BIASES,
        by_state: f,
        by_noise: noise_jacobian(after, &c, &m),
        landmarks: landmarks.collect(),
        couples: false,
    };
    if planet.turns() {
        turn_with_planet(&mut transition, (before, after), &(planet.rate_in_site_rad_s, t));
    }
    transition
}

/// Columns: noise of the rotation (axes of the lander after), of the velocity and of the position (before).
fn noise_jacobian(after: &DescentState, c: &Matrix3<f64>, after_from_before: &Matrix3<f64>) -> SMatrix<f64, 9, 9> {
    let mut g = SMatrix::<f64, 9, 9>::zeros();
    let mut set = |row: usize, column: usize, block: &Matrix3<f64>| {
        g.fixed_view_mut::<3, 3>(row, column).copy_from(block);
    };
    set(POSITION, 0, &hat(&(c * after.lander_in_site_m)));
    set(POSITION, 6, after_from_before);
    set(VELOCITY, 0, &hat(&(c * after.lander_velocity_in_site_m_s)));
    set(VELOCITY, 3, after_from_before);
    set(ATTITUDE, 0, &c.transpose());
    g
}

/// Changes a transition of (s̃, ũ, ψ) in axes that do not turn to one of (s̃, w̃, ψ): ũ = w̃ + [ω_L×] s̃ - [s×] C [ω×] ψ with
/// ω_L = C ω, and E = exp(ω T): ψ_j = Eᵀ ψ_i, l̃_j = C_j C_iᵀ l̃_i + C_j (Eᵀ [E p×] - [p×]) ψ.
fn turn_with_planet(
    transition: &mut Transition,
    (before, after): (&Core, &DescentState),
    (rate, time_s): &(Vector3<f64>, f64),
) {
    let turn = exp(&(rate * *time_s)).to_rotation_matrix().into_inner();
    let before_c = before.lander_from_site.to_rotation_matrix().into_inner();
    let after_c = after.lander_from_site.to_rotation_matrix().into_inner();
    let of_inertial = |c: &Matrix3<f64>, position_m: &Vector3<f64>| {
        let mut j = Own::identity();
        j.fixed_view_mut::<3, 3>(VELOCITY, POSITION).copy_from(&hat(&(c * rate)));
        j.fixed_view_mut::<3, 3>(VELOCITY, ATTITUDE).copy_from(&(-hat(&(c * position_m)) * c * hat(rate)));
        j
    };
    let inward = of_inertial(&before_c, &before.lander_in_site_m);
    let outward = Own::identity() * 2.0 - of_inertial(&after_c, &after.lander_in_site_m);
    let mut f = transition.by_state;
    f.fixed_view_mut::<3, 3>(ATTITUDE, ATTITUDE).copy_from(&turn.transpose());
    transition.by_state = outward * f * inward;
    // The noise of the rotation moves C_j in C_j v_j directly; that of the position moves v_j = … - ω×r_j.
    let by_position = -hat(&(after_c * rate)) * transition.by_noise.fixed_view::<3, 3>(POSITION, 6);
    transition.by_noise.fixed_view_mut::<3, 3>(VELOCITY, 6).copy_from(&by_position);
    let inertial = after_c * turn.transpose();
    for (landmark, known) in transition.landmarks.iter_mut().zip(&after.landmarks) {
        let p = known.position_in_site_m;
        landmark.by_landmark = after_c * before_c.transpose();
        let by_attitude = inertial * hat(&(turn * p)) - after_c * hat(&p);
        landmark.by_state.fixed_view_mut::<3, 3>(0, ATTITUDE).copy_from(&by_attitude);
    }
    transition.couples = true;
}

/// l - s: minus the identity for the lander, plus the identity for a landmark of the state; a known point has l = C p.
pub(super) fn relative_jacobian(
    state: &DescentState,
    point_in_site_m: &Vector3<f64>,
    is_state: bool,
) -> RelativeJacobian {
    let (by_attitude, by_landmark) = if is_state {
        (Matrix3::zeros(), Matrix3::identity())
    } else if *point_in_site_m == Vector3::zeros() {
        (Matrix3::zeros(), Matrix3::zeros())
    } else {
        (state.lander_from_site.to_rotation_matrix().into_inner() * hat(point_in_site_m), Matrix3::zeros())
    };
    RelativeJacobian { by_position: -Matrix3::identity(), by_attitude, by_landmark }
}

/// l = s + a with the arm a in lander axes.
pub(super) fn point_of_arm(state: &DescentState, arm_in_lander_m: &Vector3<f64>, reach_m: f64) -> RayPoint {
    RayPoint {
        position_in_site_m: state.lander_in_site_m + state.lander_from_site.inverse() * arm_in_lander_m,
        by_position: Matrix3::identity(),
        by_attitude: Matrix3::zeros(),
        by_bearing: Matrix3::identity() * reach_m,
        by_height: Vector3::zeros(),
    }
}

/// l = s + c + d z with d = (h - e_z·Cᵀ(s + c)) / (e_z·Cᵀ z), c the camera and z the bearing in lander axes.
pub(super) fn kept_on_ground(state: &DescentState, free: RayPoint, direction_in_lander: &Vector3<f64>) -> RayPoint {
    let up = state.lander_from_site * Vector3::z();
    let over_fall = direction_in_lander / up.dot(direction_in_lander);
    let along_ground = Matrix3::identity() - over_fall * up.transpose();
    let turn = free.position_in_site_m.cross(&Vector3::z());
    RayPoint {
        by_position: along_ground,
        by_attitude: -over_fall * turn.transpose(),
        by_bearing: along_ground * free.by_bearing,
        by_height: over_fall,
        ..free
    }
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
/// bends the error into an arc, ½ ψ² |r| across it.
pub(super) fn site_second_moment(state: &DescentState, covariance: &SMatrix<f64, 9, 9>) -> SMatrix<f64, 9, 9> {
    let site_from_lander = state.lander_from_site.inverse().to_rotation_matrix().into_inner();
    let mut turn = SMatrix::<f64, 9, 9>::identity();
    turn.fixed_view_mut::<3, 3>(POSITION, POSITION).copy_from(&site_from_lander);
    turn.fixed_view_mut::<3, 3>(VELOCITY, VELOCITY).copy_from(&site_from_lander);
    let p = turn * covariance * turn.transpose();
    let hessians: [SMatrix<f64, 9, 9>; 6] = std::array::from_fn(|row| {
        let (start, vector) =
            if row < 3 { (POSITION, &state.lander_in_site_m) } else { (VELOCITY, &state.lander_velocity_in_site_m_s) };
        second_derivative(row % 3, start, vector)
    });
    let bend = QuadraticMoments::new(&hessians, &p);
    let mut moment = SMatrix::<f64, 9, 9>::zeros();
    moment.fixed_view_mut::<6, 6>(0, 0).copy_from(&(bend.covariance + bend.mean * bend.mean.transpose()));
    moment
}

/// A_i of component i of ψ×e + ½ ψ×(ψ×r̂), where e starts at `start`.
fn second_derivative(i: usize, start: usize, vector: &Vector3<f64>) -> SMatrix<f64, 9, 9> {
    let mut a = SMatrix::<f64, 9, 9>::zeros();
    let axis = Vector3::ith(i, 1.0);
    // e_i · (ψ × e) = ψ · (e × e_i) = -ψᵀ [e_i×] e.
    let mixed = -hat(&axis);
    a.fixed_view_mut::<3, 3>(ATTITUDE, start).copy_from(&mixed);
    a.fixed_view_mut::<3, 3>(start, ATTITUDE).copy_from(&mixed.transpose());
    let bend = symmetric(&(axis * vector.transpose())) - Matrix3::identity() * vector[i];
    a.fixed_view_mut::<3, 3>(ATTITUDE, ATTITUDE).copy_from(&bend);
    a
}
