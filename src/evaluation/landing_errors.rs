//! What a landing is off by at one epoch.

use super::consistency::NormalizedSample;
use super::landing_epochs::LandingEpoch;
use super::true_motion::lander_state_at;
use crate::dataset::truth::LanderState;
use crate::geometry::so3::log;
use nalgebra::{Isometry3, Matrix3, SMatrix, SVector, UnitQuaternion, Vector3};
use std::f64::consts::{PI, TAU};

/// True less estimated state at one epoch.
pub struct LandingErrors {
    pub t_ns: i64,
    pub t_s: f64,
    pub position_m: Vector3<f64>,
    pub velocity_m_s: Vector3<f64>,
    pub roll_pitch_yaw_rad: Vector3<f64>,
    pub sigma: Option<SVector<f64, 9>>,
    pub normalized: Option<NormalizedSample<9>>,
    pub estimated_designated_in_site_m: Vector3<f64>,
    pub true_site_from_lander: Isometry3<f64>,
    pub estimated_site_from_lander: Isometry3<f64>,
}

/// The errors of an epoch; `None` outside the time of the truth.
pub fn landing_errors(states: &[LanderState], epoch: &LandingEpoch) -> Option<LandingErrors> {
    let truth = lander_state_at(states, epoch.t_ns)?;
    let (true_pose, estimated) = (truth.site_from_lander, epoch.site_from_lander);
    let position_m = true_pose.translation.vector - estimated.translation.vector;
    let velocity_m_s = truth.lander_velocity_in_site_m_s - epoch.lander_velocity_in_site_m_s;
    let psi_rad = log(&(true_pose.rotation * estimated.rotation.inverse()));
    let mut error = SVector::<f64, 9>::zeros();
    error.fixed_rows_mut::<3>(0).copy_from(&position_m);
    error.fixed_rows_mut::<3>(3).copy_from(&velocity_m_s);
    error.fixed_rows_mut::<3>(6).copy_from(&psi_rad);
    let t_s = (epoch.t_ns - states[0].t_ns) as f64 * 1e-9;
    let turn = roll_pitch_yaw(&true_pose.rotation) - roll_pitch_yaw(&estimated.rotation);
    Some(LandingErrors {
        t_ns: epoch.t_ns,
        t_s,
        position_m,
        velocity_m_s,
        roll_pitch_yaw_rad: turn.map(|angle| (angle + PI).rem_euclid(TAU) - PI),
        sigma: epoch.covariance.map(|c| sigma_of(&c, &estimated.rotation)).or(epoch.sigma),
        normalized: epoch.covariance.and_then(|covariance| NormalizedSample::new(t_s, &error, &covariance)),
        estimated_designated_in_site_m: epoch.designated_in_site_m,
        true_site_from_lander: true_pose,
        estimated_site_from_lander: estimated,
    })
}

/// 1σ of x, y, z, roll, pitch, yaw, vx, vy, vz by a covariance whose attitude part is ψ in site axes:
/// `ψ = J (roll, pitch, yaw)` with the columns of `J` the axes that the three angles turn about.
fn sigma_of(covariance: &SMatrix<f64, 9, 9>, site_from_lander: &UnitQuaternion<f64>) -> SVector<f64, 9> {
    let (_, pitch, yaw) = site_from_lander.euler_angles();
    let turn = |pitch: f64| UnitQuaternion::from_euler_angles(0.0, pitch, yaw);
    let axes = [turn(pitch) * Vector3::x(), turn(0.0) * Vector3::y(), Vector3::z()];
    let psi = covariance.fixed_view::<3, 3>(6, 6).into_owned();
    // At a pitch of 90° roll and yaw cannot be told apart: the site-axes values stand in.
    let by_psi = Matrix3::from_columns(&axes).try_inverse().unwrap_or_else(Matrix3::identity);
    let angles = by_psi * psi * by_psi.transpose();
    let variance = covariance.diagonal();
    let sigma = |k: usize| match k {
        0..3 => variance[k],
        3..6 => angles[(k - 3, k - 3)],
        _ => variance[k - 3],
    };
    SVector::from_fn(|k, _| sigma(k).max(0.0).sqrt())
}

/// Roll, pitch and yaw of `site_from_lander = Rz(yaw) Ry(pitch) Rx(roll)`. A wrong yaw leaves roll and pitch alone, so
/// the heading, which nothing observes, does not hide the tilt.
fn roll_pitch_yaw(site_from_lander: &UnitQuaternion<f64>) -> Vector3<f64> {
    let (roll, pitch, yaw) = site_from_lander.euler_angles();
    Vector3::new(roll, pitch, yaw)
}
