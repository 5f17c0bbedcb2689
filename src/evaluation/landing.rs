//! Errors of a landing: state, consistency, trajectory, and the verdict at touchdown.

use super::consistency::NormalizedSample;
use super::error::EvaluationError;
use super::ground::{TrackedGround, TrackedPixel, tracked_ground};
use super::landing_epochs::{LandingEpoch, read_landing_epochs};
use super::metrics::{Metrics, Series, Verdict};
use super::spread::root_mean_square;
use super::true_camera::TrueCamera;
use super::true_motion::lander_state_at;
use crate::dataset::truth::{LanderState, read_lander_states};
use crate::geometry::so3::log;
use nalgebra::{Isometry3, Matrix3, SMatrix, SVector, UnitQuaternion, Vector3};
use std::f64::consts::{PI, TAU};
use std::path::Path;

/// True less estimated state at one epoch.
struct LandingError {
    t_ns: i64,
    t_s: f64,
    position_m: Vector3<f64>,
    velocity_m_s: Vector3<f64>,
    roll_pitch_yaw_rad: Vector3<f64>,
    sigma: Option<SVector<f64, 9>>,
    normalized: Option<NormalizedSample<9>>,
    estimated_designated_in_site_m: Vector3<f64>,
    true_site_from_lander: Isometry3<f64>,
    estimated_site_from_lander: Isometry3<f64>,
}

/// Adds every figure, verdict and curve of a landing.
pub fn evaluate_landing(
    result: &Path,
    root: &Path,
    tracks: &[TrackedPixel],
    metrics: &mut Metrics,
) -> Result<(), EvaluationError> {
    let states = read_lander_states(root)?;
    let epochs = read_landing_epochs(result)?;
    let errors: Vec<LandingError> = epochs.iter().filter_map(|epoch| landing_error(&states, epoch)).collect();
    if errors.is_empty() {
        return Err(EvaluationError::no_common_time(result, root));
    }
    metrics.add_epochs(errors.len(), epochs.len());
    add_series(&errors, metrics);
    add_consistency(&errors, metrics);
    add_trajectory(&errors, metrics);
    add_final_errors(&errors, root, tracks, metrics)
}

fn landing_error(states: &[LanderState], epoch: &LandingEpoch) -> Option<LandingError> {
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
    Some(LandingError {
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

fn add_series(errors: &[LandingError], metrics: &mut Metrics) {
    for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
        let name = format!("position_error_{letter}");
        add_curve(errors, &Curve { name: &name, unit: "m", scale: 1.0 }, (|e, k| e.position_m[k], axis), metrics);
    }
    for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
        let name = format!("velocity_error_{letter}");
        add_curve(
            errors,
            &Curve { name: &name, unit: "m/s", scale: 1.0 },
            (|e, k| e.velocity_m_s[k - 6], 6 + axis),
            metrics,
        );
    }
    for (axis, name) in ["roll_error", "pitch_error", "yaw_error"].into_iter().enumerate() {
        let degrees = Curve { name, unit: "deg", scale: 1f64.to_degrees() };
        add_curve(errors, &degrees, (|e, k| e.roll_pitch_yaw_rad[k - 3], 3 + axis), metrics);
    }
}

/// What a curve is called, and its scale from SI to its unit.
struct Curve<'a> {
    name: &'a str,
    unit: &'a str,
    scale: f64,
}

/// One curve, and the component `k` of the file's 1σ that goes with it.
fn add_curve(
    errors: &[LandingError],
    curve: &Curve,
    (component, k): (fn(&LandingError, usize) -> f64, usize),
    metrics: &mut Metrics,
) {
    let sigma: Option<Vec<f64>> = errors.iter().map(|e| Some(e.sigma?[k] * curve.scale)).collect();
    metrics.series.push(Series {
        name: curve.name.into(),
        unit: curve.unit.into(),
        t_s: errors.iter().map(|e| e.t_s).collect(),
        values: errors.iter().map(|e| component(e, k) * curve.scale).collect(),
        sigma: sigma.unwrap_or_default(),
        bound: None,
    });
}

fn add_consistency(errors: &[LandingError], metrics: &mut Metrics) {
    let samples: Vec<_> = errors.iter().filter_map(|e| e.normalized).collect();
    metrics.add_consistency(&samples, errors.len());
}

fn add_trajectory(errors: &[LandingError], metrics: &mut Metrics) {
    metrics.add("ate_position_rms", root_mean_square(errors.iter().map(|e| e.position_m.norm())), "m");
    metrics.note(
        "ATE is the r.m.s. of the position error without alignment: the site frame is fixed by the designated point.",
    );
    let (mut shift_m, mut turn_rad) = (vec![], vec![]);
    for (index, from) in errors.iter().enumerate() {
        let Some(to) = errors[index..].iter().find(|e| e.t_ns - from.t_ns >= RPE_INTERVAL_NS) else { break };
        let moved = |a: &Isometry3<f64>, b: &Isometry3<f64>| a.inverse() * b;
        let truth = moved(&from.true_site_from_lander, &to.true_site_from_lander);
        let estimate = moved(&from.estimated_site_from_lander, &to.estimated_site_from_lander);
        let off = truth.inverse() * estimate;
        shift_m.push(off.translation.vector.norm());
        turn_rad.push(off.rotation.angle());
    }
    metrics.add("rpe_10s_position_rms", root_mean_square(shift_m), "m");
    metrics.add("rpe_10s_attitude_rms", root_mean_square(turn_rad).map(f64::to_degrees), "deg");
}

const RPE_INTERVAL_NS: i64 = 10_000_000_000;

fn add_final_errors(
    errors: &[LandingError],
    root: &Path,
    tracks: &[TrackedPixel],
    metrics: &mut Metrics,
) -> Result<(), EvaluationError> {
    let end = errors.last().expect("there is an epoch");
    add_state_errors("final", end, metrics);
    let last_picture_ns = tracks.iter().map(|o| o.t_ns).max();
    let last_seen = last_picture_ns.and_then(|t_ns| errors.iter().rev().find(|e| e.t_ns <= t_ns));
    match last_seen {
        Some(epoch) => {
            metrics.add("last_picture_time", epoch.t_s, "s");
            add_state_errors("last_picture", epoch, metrics);
        }
        None => metrics.note("Without tracks.csv the errors at the last picture cannot be told from those at the end."),
    }
    add_verdict("converged", "the site's origin", end, None, metrics);
    let ground = match TrueCamera::read(root) {
        Ok(camera) => tracked_ground(tracks, &camera)?,
        Err(error) => {
            metrics.note(format!("The tracked ground point is unknown: {error}."));
            None
        }
    };
    match ground {
        Some(TrackedGround { last_in_site_m: Some(point), first_in_site_m, far_error_px, .. }) => {
            if let Some(error_px) = far_error_px {
                metrics.add("tracked_point_pixel_error_beyond_3km_max", error_px, "px");
            }
            metrics.add("tracked_point_from_site_origin", point.norm(), "m");
            if let Some(first) = first_in_site_m {
                metrics.add("tracked_point_drift", (point - first).norm(), "m");
            }
            add_position_errors("final_from_tracked_point", end, Some(&point), metrics);
            if let Some(epoch) = last_seen {
                add_position_errors("last_picture_from_tracked_point", epoch, Some(&point), metrics);
            }
            add_verdict("converged_from_tracked_point", "the ground point really tracked", end, Some(&point), metrics);
        }
        _ => metrics.note(
            "The ground under the last observation of track 0 is unknown (no such track or no true depth): the verdict is \
             given against the site's origin only.",
        ),
    }
    Ok(())
}

/// Error of the position relative to the site's origin, or relative to the ground point of track 0, given where that
/// point truly is: what counts in a landing is the lander's place above the point that it steers for.
fn position_error_m(error: &LandingError, tracked_point_in_site_m: Option<&Vector3<f64>>) -> Vector3<f64> {
    let of_point = |truly: &Vector3<f64>| truly - error.estimated_designated_in_site_m;
    error.position_m - tracked_point_in_site_m.map_or_else(Vector3::zeros, of_point)
}

fn add_position_errors(
    prefix: &str,
    error: &LandingError,
    point_in_site_m: Option<&Vector3<f64>>,
    metrics: &mut Metrics,
) {
    let position = position_error_m(error, point_in_site_m);
    metrics.add(&format!("{prefix}_horizontal_error"), position.xy().norm(), "m");
    metrics.add(&format!("{prefix}_z_error"), position.z, "m");
}

fn add_state_errors(prefix: &str, error: &LandingError, metrics: &mut Metrics) {
    add_position_errors(prefix, error, None, metrics);
    metrics.add(&format!("{prefix}_speed_error"), error.velocity_m_s.norm(), "m/s");
    for (axis, name) in ["roll", "pitch", "yaw"].into_iter().enumerate() {
        metrics.add(&format!("{prefix}_{name}_error"), error.roll_pitch_yaw_rad[axis].to_degrees(), "deg");
    }
}

/// Converged: horizontal < 1 m, z < 40 m, |v| < 0.5 m/s, roll and pitch < 0.1°.
fn add_verdict(
    name: &str,
    origin: &str,
    error: &LandingError,
    point_in_site_m: Option<&Vector3<f64>>,
    metrics: &mut Metrics,
) {
    let position = position_error_m(error, point_in_site_m);
    let tilt_deg = error.roll_pitch_yaw_rad.xy().map(|angle| angle.to_degrees().abs());
    let limits = [
        ("horizontal error", position.xy().norm(), 1.0, "m"),
        ("z error", position.z.abs(), 40.0, "m"),
        ("velocity error", error.velocity_m_s.norm(), 0.5, "m/s"),
        ("roll error", tilt_deg.x, 0.1, "deg"),
        ("pitch error", tilt_deg.y, 0.1, "deg"),
    ];
    let broken: Vec<String> = limits
        .iter()
        .filter(|(_, value, limit, _)| value.is_nan() || value >= limit)
        .map(|(what, value, limit, unit)| format!("{what} {value:.3} {unit} is not under {limit} {unit}"))
        .collect();
    let holds = broken.is_empty();
    let kept = "every error is under its limit (horizontal 1 m, z 40 m, velocity 0.5 m/s, roll and pitch 0.1 deg)";
    let why = if holds { kept.to_string() } else { broken.join("; ") };
    let reason = format!("at {:.1} s against {origin}: {why}", error.t_s);
    metrics.verdicts.push(Verdict { name: name.into(), holds, reason });
}
