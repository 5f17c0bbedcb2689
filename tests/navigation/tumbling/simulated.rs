//! Sequences of relative rotations along an integrated motion; nothing of the scene is used.

use crate::reference_body::{RATIOS, rate_rad_s};
use nalgebra::{Matrix3, SVector, UnitQuaternion, Vector3};
use opnav::geometry::{Manifold, so3};
use opnav::navigation::tumbling::*;
use opnav::observations::{PairStatus, RelativeRotation, RotationModel};
use opnav::stats::{normalized_error_squared, random_stream};
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;

const SIGMA_RAD: f64 = 0.05 * std::f64::consts::PI / 180.0;

pub fn rate_deg_s(x: f64, y: f64, z: f64) -> Vector3<f64> {
    Vector3::new(x.to_radians(), y.to_radians(), z.to_radians())
}

pub fn at_start(rate_rad_s: Vector3<f64>) -> SpinState {
    SpinState { asteroid_from_inertial: UnitQuaternion::identity(), rate_in_asteroid_rad_s: rate_rad_s }
}

/// A simulated sequence.
pub struct Sequence {
    pub truth: Vec<SpinState>,
    pub inertia: InertiaRatios,
    pub times_ns: Vec<i64>,
    pub pairs: Vec<RelativeRotation>,
}

pub fn design(arc_s: f64, interval_s: f64) -> ArcDesign {
    ArcDesign {
        arc_s,
        interval_s,
        sigma_rad: SIGMA_RAD,
        keyframe_turn_rad: Some(30f64.to_radians()),
        loop_turn_rad: None,
    }
}

/// Pairs of `design` along a motion; `noise` in units of the stated standard deviation.
pub fn simulate(rate: Vector3<f64>, inertia: InertiaRatios, design: &ArcDesign, noise: f64, seed: u64) -> Sequence {
    let steps = (design.arc_s / design.interval_s).round() as usize;
    let times_s: Vec<f64> = (0..=steps).map(|k| k as f64 * design.interval_s).collect();
    let truth: Vec<SpinState> =
        propagate(&at_start(rate), &inertia, &times_s).unwrap().iter().map(|p| p.state).collect();
    let attitudes: Vec<_> = truth.iter().map(|s| s.asteroid_from_inertial).collect();
    let times_ns: Vec<i64> = times_s.iter().map(|t| 1_000_000_000 + (t * 1e9).round() as i64).collect();
    let mut random = random_stream(seed, "pairs", 0);
    let pairs = planned_pairs(&attitudes, design)
        .into_iter()
        .map(|(from, to)| {
            let error = Vector3::from_fn(|_, _| -> f64 { StandardNormal.sample(&mut random) });
            let exact = attitudes[to].inverse() * attitudes[from];
            RelativeRotation {
                t_ns_from: times_ns[from],
                t_ns_to: times_ns[to],
                camera_to_from_camera_from: so3::exp(&(error * -noise * design.sigma_rad)) * exact,
                covariance_rad2: Matrix3::identity() * design.sigma_rad.powi(2),
                matches: 100,
                inliers: 100,
                model: RotationModel::FixedCenter,
                status: PairStatus::Ok,
            }
        })
        .collect();
    Sequence { truth, inertia, times_ns, pairs }
}

pub fn run(sequence: &Sequence, config: &TumblingConfig) -> TumblingResult {
    estimate(&sequence.pairs, &sequence.times_ns, config).unwrap()
}

pub fn using(estimator: Estimator) -> TumblingConfig {
    TumblingConfig { estimator, ..TumblingConfig::default() }
}

pub fn rate_errors_rad_s(sequence: &Sequence, result: &TumblingResult) -> Vec<f64> {
    let pairs = sequence.truth.iter().zip(&result.epochs);
    pairs.map(|(t, e)| (t.rate_in_asteroid_rad_s - e.rate_in_asteroid_rad_s).norm()).collect()
}

pub fn rms(values: impl IntoIterator<Item = f64>) -> f64 {
    let squares: Vec<f64> = values.into_iter().map(|v| v * v).collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

pub fn worst_ratio_error(inertia: &InertiaRatios, estimate: &[f64; 5]) -> f64 {
    (0..5).map(|i| (inertia.0[i] - estimate[i]).abs()).fold(0.0, f64::max)
}

pub fn nees_at_end(sequence: &Sequence, result: &TumblingResult) -> f64 {
    let last = result.epochs.last().unwrap();
    let error = sequence.truth.last().unwrap().minus(&last.state());
    normalized_error_squared(&error, &last.covariance).unwrap()
}

pub fn ratio_nees(inertia: &InertiaRatios, result: &TumblingResult) -> f64 {
    let error = inertia.vector() - SVector::<f64, 5>::from(result.inertia_ratios.unwrap());
    normalized_error_squared(&error, &result.inertia_covariance.unwrap()).unwrap()
}

/// Mean NEES per degree of freedom at the end (state, ratios) over seeded runs.
pub fn mean_nees(runs: u64, arc_s: f64, config: &TumblingConfig, spoil: impl Fn(&mut Sequence) + Sync) -> (f64, f64) {
    let all: Vec<(f64, f64)> = (0..runs)
        .into_par_iter()
        .map(|seed| {
            let mut sequence = simulate(rate_rad_s(), RATIOS, &design(arc_s, 1.0), 1.0, seed);
            spoil(&mut sequence);
            let result = run(&sequence, config);
            (nees_at_end(&sequence, &result) / 6.0, ratio_nees(&RATIOS, &result) / 5.0)
        })
        .collect();
    let n = runs as f64;
    (all.iter().map(|a| a.0).sum::<f64>() / n, all.iter().map(|a| a.1).sum::<f64>() / n)
}
