//! Errors of a landing: state, consistency, trajectory.

use super::error::EvaluationError;
use super::ground::TrackedPixel;
use super::landing_end::add_final_errors;
use super::landing_epochs::read_landing_epochs;
use super::landing_errors::{LandingErrors, landing_errors};
use super::metrics::{Metrics, Series};
use super::spread::root_mean_square;
use crate::dataset::truth::read_lander_states;
use nalgebra::Isometry3;
use std::path::Path;

/// Adds every figure, verdict and curve of a landing.
pub fn evaluate_landing(
    result: &Path,
    root: &Path,
    tracks: &[TrackedPixel],
    metrics: &mut Metrics,
) -> Result<(), EvaluationError> {
    let states = read_lander_states(root)?;
    let epochs = read_landing_epochs(result)?;
    let errors: Vec<LandingErrors> = epochs.iter().filter_map(|epoch| landing_errors(&states, epoch)).collect();
    if errors.is_empty() {
        return Err(EvaluationError::no_common_time(result, root));
    }
    metrics.add_epochs(errors.len(), epochs.len());
    add_series(&errors, metrics);
    add_consistency(&errors, metrics);
    add_trajectory(&errors, metrics);
    add_final_errors(&errors, root, tracks, metrics)
}

fn add_series(errors: &[LandingErrors], metrics: &mut Metrics) {
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
    errors: &[LandingErrors],
    curve: &Curve,
    (component, k): (fn(&LandingErrors, usize) -> f64, usize),
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

fn add_consistency(errors: &[LandingErrors], metrics: &mut Metrics) {
    let samples: Vec<_> = errors.iter().filter_map(|e| e.normalized).collect();
    metrics.add_consistency(&samples, errors.len());
}

fn add_trajectory(errors: &[LandingErrors], metrics: &mut Metrics) {
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
