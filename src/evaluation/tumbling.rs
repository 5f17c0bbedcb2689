//! Errors of a small body's attitude, rate and inertia ratios.
//!
//! The estimator's asteroid axes are the camera's axes at the start `t0`; the truth's are the mesh's. The two differ by
//! a constant rotation that no image can tell, so the truth is turned into the estimator's axes by its own attitude at
//! `t0`: `estimate_from_truth = asteroid_from_inertial(t0)⁻¹`. Which axes the truth happens to use has no effect.

use super::consistency::NormalizedSample;
use super::error::EvaluationError;
use super::metrics::{Metrics, Series};
use super::spread::root_mean_square;
use super::true_motion::asteroid_state_at;
use super::tumbling_epochs::{INERTIA_NAMES, TumblingEpoch, read_tumbling_epochs};
use crate::dataset::read_tum;
use crate::dataset::truth::{AsteroidInertia, AsteroidState, read_asteroid};
use crate::geometry::Manifold;
use nalgebra::{SVector, UnitQuaternion, Vector3};
use std::path::Path;

/// True less estimated state at one epoch: the attitude error in inertial axes (the camera's), the rate error in the
/// estimator's asteroid axes.
struct TumblingErrors {
    t_s: f64,
    attitude_rad: Vector3<f64>,
    rate_rad_s: Vector3<f64>,
    sigma: Option<SVector<f64, 6>>,
    normalized: Option<NormalizedSample<6>>,
}

/// The truth in the estimator's axes.
struct AlignedTruth {
    states: Vec<AsteroidState>,
    /// Lxx, Lyy, Lxy, Lxz, Lyz in units of Lzz.
    inertia: [f64; 5],
}

/// Adds every figure and curve of a tumbling result; `start_ns` is the time of the first image that was used.
pub fn evaluate_tumbling(
    result: &Path,
    root: &Path,
    start_ns: Option<i64>,
    metrics: &mut Metrics,
) -> Result<(), EvaluationError> {
    let epochs = read_tumbling_epochs(result)?;
    let truth = aligned_truth(result, root, start_ns)?;
    let start_of_truth_ns = truth.states[0].t_ns;
    let errors: Vec<TumblingErrors> =
        epochs.iter().filter_map(|epoch| tumbling_error(&truth, epoch, start_of_truth_ns)).collect();
    if errors.is_empty() {
        return Err(EvaluationError::no_common_time(result, root));
    }
    metrics.add_epochs(errors.len(), epochs.len());
    add_series(&errors, metrics);
    let samples: Vec<_> = errors.iter().filter_map(|e| e.normalized).collect();
    metrics.add_consistency(&samples, errors.len());
    add_motion_figures(&errors, metrics);
    add_inertia(&truth, &epochs, start_of_truth_ns, metrics);
    Ok(())
}

/// Turns states and inertia into the estimator's asteroid axes, and inertial axes into the camera's.
fn aligned_truth(result: &Path, root: &Path, start_ns: Option<i64>) -> Result<AlignedTruth, EvaluationError> {
    let (states, inertia) = read_asteroid(root)?;
    let start_ns = start_ns.unwrap_or(states[0].t_ns);
    let start = asteroid_state_at(&states, start_ns).ok_or_else(|| EvaluationError::no_common_time(result, root))?;
    let inertial_from_camera = inertial_from_camera(root, &start)?;
    let estimate_from_truth = (start.asteroid_from_inertial * inertial_from_camera).inverse();
    let align = |state: &AsteroidState| AsteroidState {
        t_ns: state.t_ns,
        asteroid_from_inertial: estimate_from_truth * state.asteroid_from_inertial * inertial_from_camera,
        rate_in_asteroid_rad_s: estimate_from_truth * state.rate_in_asteroid_rad_s,
    };
    let states = states.iter().map(align).collect();
    Ok(AlignedTruth { states, inertia: inertia_ratios(&inertia, &estimate_from_truth) })
}

/// Rotation between the camera's axes and the truth's inertial ones, from `truth/cam0.tum` at the start; identity where
/// there is no such pose.
fn inertial_from_camera(root: &Path, start: &AsteroidState) -> Result<UnitQuaternion<f64>, EvaluationError> {
    let path = root.join("truth/cam0.tum");
    if !path.is_file() {
        return Ok(UnitQuaternion::identity());
    }
    let poses = read_tum(&path)?;
    let pose = poses.iter().find(|p| p.t_ns == start.t_ns);
    let asteroid_from_camera = pose.map(|p| p.reference_from_moving.rotation);
    Ok(asteroid_from_camera.map_or(UnitQuaternion::identity(), |q| start.asteroid_from_inertial.inverse() * q))
}

fn inertia_ratios(inertia: &AsteroidInertia, estimate_from_truth: &UnitQuaternion<f64>) -> [f64; 5] {
    let turn = estimate_from_truth.to_rotation_matrix();
    let turned = turn.matrix() * inertia.matrix() * turn.matrix().transpose();
    let ratio = turned / turned[(2, 2)];
    [ratio[(0, 0)], ratio[(1, 1)], ratio[(0, 1)], ratio[(0, 2)], ratio[(1, 2)]]
}

fn tumbling_error(truth: &AlignedTruth, epoch: &TumblingEpoch, start_of_truth_ns: i64) -> Option<TumblingErrors> {
    let state = asteroid_state_at(&truth.states, epoch.t_ns)?;
    let attitude_rad = state.asteroid_from_inertial.minus(&epoch.asteroid_from_inertial);
    let rate_rad_s = state.rate_in_asteroid_rad_s - epoch.rate_in_asteroid_rad_s;
    let mut error = SVector::<f64, 6>::zeros();
    error.fixed_rows_mut::<3>(0).copy_from(&attitude_rad);
    error.fixed_rows_mut::<3>(3).copy_from(&rate_rad_s);
    let t_s = (epoch.t_ns - start_of_truth_ns) as f64 * 1e-9;
    Some(TumblingErrors {
        t_s,
        attitude_rad,
        rate_rad_s,
        sigma: epoch.covariance.map(|c| c.diagonal().map(|variance| variance.max(0.0).sqrt())),
        normalized: epoch.covariance.and_then(|covariance| NormalizedSample::new(t_s, &error, &covariance)),
    })
}

fn add_series(errors: &[TumblingErrors], metrics: &mut Metrics) {
    for axis in 0..6 {
        let (group, unit) = if axis < 3 { ("attitude", "deg") } else { ("rate", "deg/s") };
        let value = |e: &TumblingErrors| if axis < 3 { e.attitude_rad[axis] } else { e.rate_rad_s[axis - 3] };
        let sigma: Option<Vec<f64>> = errors.iter().map(|e| Some(e.sigma?[axis].to_degrees())).collect();
        metrics.series.push(Series {
            name: format!("{group}_error_{}", ["x", "y", "z"][axis % 3]),
            unit: unit.into(),
            t_s: errors.iter().map(|e| e.t_s).collect(),
            values: errors.iter().map(|e| value(e).to_degrees()).collect(),
            sigma: sigma.unwrap_or_default(),
            bound: None,
        });
    }
}

fn add_motion_figures(errors: &[TumblingErrors], metrics: &mut Metrics) {
    let last_fifth = &errors[errors.len() - errors.len().div_ceil(5)..];
    let end = errors.last().expect("there is an epoch");
    metrics.add("final_attitude_error", end.attitude_rad.norm().to_degrees(), "deg");
    metrics.add("final_rate_error", end.rate_rad_s.norm().to_degrees(), "deg/s");
    for (name, part) in [("rms", errors), ("rms_last_fifth", last_fifth)] {
        let attitude = root_mean_square(part.iter().map(|e| e.attitude_rad.norm().to_degrees()));
        let rate = root_mean_square(part.iter().map(|e| e.rate_rad_s.norm().to_degrees()));
        metrics.add(&format!("attitude_error_{name}"), attitude, "deg");
        metrics.add(&format!("rate_error_{name}"), rate, "deg/s");
    }
}

fn add_inertia(truth: &AlignedTruth, epochs: &[TumblingEpoch], start_ns: i64, metrics: &mut Metrics) {
    let last = epochs.last().expect("there is an epoch");
    let mut worst: Option<f64> = None;
    for (k, name) in INERTIA_NAMES.into_iter().enumerate() {
        metrics.add(&format!("true_{name}"), truth.inertia[k], "Lzz");
        match last.inertia[k] {
            Some(estimated) => {
                let error = truth.inertia[k] - estimated;
                worst = Some(worst.unwrap_or(0.0).max(error.abs()));
                metrics.add(&format!("{name}_error"), error, "Lzz");
            }
            None => metrics.note(format!("The estimator calls {name} not determined and gives no number for it.")),
        }
        if let Some(sigma) = last.inertia_sigma[k] {
            metrics.add(&format!("{name}_sigma"), sigma, "Lzz");
        }
        add_inertia_series(truth.inertia[k], epochs, (k, start_ns), metrics);
    }
    if let Some(worst) = worst {
        metrics.add("worst_inertia_error", worst, "Lzz");
    }
}

fn add_inertia_series(truth: f64, epochs: &[TumblingEpoch], (k, start_ns): (usize, i64), metrics: &mut Metrics) {
    let known: Vec<_> = epochs.iter().filter_map(|e| Some((e, e.inertia[k]?))).collect();
    let sigma: Option<Vec<f64>> = known.iter().map(|(e, _)| e.inertia_sigma[k]).collect();
    metrics.series.push(Series {
        name: format!("{}_error", INERTIA_NAMES[k]),
        unit: "Lzz".into(),
        t_s: known.iter().map(|(e, _)| (e.t_ns - start_ns) as f64 * 1e-9).collect(),
        values: known.iter().map(|(_, estimated)| truth - estimated).collect(),
        sigma: sigma.unwrap_or_default(),
        bound: None,
    });
}
