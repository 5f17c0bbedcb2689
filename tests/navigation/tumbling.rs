//! Tests of the room `tumbling`. The truth is integrated here from the printed case; nothing of the scene is used.

use nalgebra::{Matrix3, Quaternion, SMatrix, SVector, UnitQuaternion, Vector3};
use opnav::dataset::read_timed_table;
use opnav::geometry::{Manifold, central_difference, so3};
use opnav::navigation::tumbling::*;
use opnav::observations::{PairStatus, RelativeRotation, RotationModel};
use opnav::stats::{ConsistencyBounds, normalized_error_squared, random_stream};
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;

const PAPER: InertiaRatios = InertiaRatios([0.85, 1.37, 0.13, 0.17, -0.11]);
const SIGMA_RAD: f64 = 0.05 * std::f64::consts::PI / 180.0;

fn rate_deg_s(x: f64, y: f64, z: f64) -> Vector3<f64> {
    Vector3::new(x.to_radians(), y.to_radians(), z.to_radians())
}

fn paper_rate() -> Vector3<f64> {
    rate_deg_s(5.0, 2.3, 3.5)
}

fn at_start(rate_rad_s: Vector3<f64>) -> SpinState {
    SpinState { asteroid_from_inertial: UnitQuaternion::identity(), rate_in_asteroid_rad_s: rate_rad_s }
}

/// A simulated sequence.
struct Sequence {
    truth: Vec<SpinState>,
    inertia: InertiaRatios,
    times_ns: Vec<i64>,
    pairs: Vec<RelativeRotation>,
}

fn design(arc_s: f64, interval_s: f64) -> ArcDesign {
    ArcDesign {
        arc_s,
        interval_s,
        sigma_rad: SIGMA_RAD,
        keyframe_turn_rad: Some(30f64.to_radians()),
        loop_turn_rad: None,
    }
}

/// Pairs of `design` along a motion; `noise` in units of the stated standard deviation.
fn simulate(rate: Vector3<f64>, inertia: InertiaRatios, design: &ArcDesign, noise: f64, seed: u64) -> Sequence {
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

fn run(sequence: &Sequence, config: &TumblingConfig) -> TumblingResult {
    estimate(&sequence.pairs, &sequence.times_ns, config).unwrap()
}

fn using(estimator: Estimator) -> TumblingConfig {
    TumblingConfig { estimator, ..TumblingConfig::default() }
}

fn rate_errors_rad_s(sequence: &Sequence, result: &TumblingResult) -> Vec<f64> {
    let pairs = sequence.truth.iter().zip(&result.epochs);
    pairs.map(|(t, e)| (t.rate_in_asteroid_rad_s - e.rate_in_asteroid_rad_s).norm()).collect()
}

fn rms(values: impl IntoIterator<Item = f64>) -> f64 {
    let squares: Vec<f64> = values.into_iter().map(|v| v * v).collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

fn worst_ratio_error(inertia: &InertiaRatios, estimate: &[f64; 5]) -> f64 {
    (0..5).map(|i| (inertia.0[i] - estimate[i]).abs()).fold(0.0, f64::max)
}

fn nees_at_end(sequence: &Sequence, result: &TumblingResult) -> f64 {
    let last = result.epochs.last().unwrap();
    let error = sequence.truth.last().unwrap().minus(&last.state());
    normalized_error_squared(&error, &last.covariance).unwrap()
}

fn ratio_nees(inertia: &InertiaRatios, result: &TumblingResult) -> f64 {
    let error = inertia.vector() - SVector::<f64, 5>::from(result.inertia_ratios.unwrap());
    normalized_error_squared(&error, &result.inertia_covariance.unwrap()).unwrap()
}

/// Mean NEES per degree of freedom at the end (state, ratios) over seeded runs.
fn mean_nees(runs: u64, arc_s: f64, config: &TumblingConfig, spoil: impl Fn(&mut Sequence) + Sync) -> (f64, f64) {
    let all: Vec<(f64, f64)> = (0..runs)
        .into_par_iter()
        .map(|seed| {
            let mut sequence = simulate(paper_rate(), PAPER, &design(arc_s, 1.0), 1.0, seed);
            spoil(&mut sequence);
            let result = run(&sequence, config);
            (nees_at_end(&sequence, &result) / 6.0, ratio_nees(&PAPER, &result) / 5.0)
        })
        .collect();
    let n = runs as f64;
    (all.iter().map(|a| a.0).sum::<f64>() / n, all.iter().map(|a| a.1).sum::<f64>() / n)
}

#[test]
fn jacobians_are_the_printed_ones_and_agree_with_differences() {
    let body = FreeBody::new(&PAPER).unwrap();
    let rate = paper_rate();
    let acceleration = Vector3::new(1.217511829e-3, 2.93714897e-4, -1.773544285e-3);
    assert!((body.acceleration_rad_s2(&rate) - acceleration).norm() < 1e-11);
    let m = Matrix3::new(
        0.005038761047,
        0.028564731271,
        0.013892540408,
        0.021810000755,
        -0.018034745273,
        -0.009689383329,
        -0.035301389804,
        -0.031396608872,
        0.012995984226,
    );
    let n = SMatrix::<f64, 3, 5>::from_row_slice(&[
        -0.001579831847,
        0.003879219443,
        0.008116078247,
        -0.00295674056,
        0.00318858645,
        -0.003468990953,
        -0.000924880967,
        -0.004077608013,
        0.003284006074,
        0.003081084495,
        0.003390082737,
        -0.004264304539,
        -0.007832279528,
        0.002098544964,
        -0.005827660146,
    ]);
    assert!((body.acceleration_by_rate(&rate) - m).amax() < 1e-11);
    assert!((body.acceleration_by_inertia(&rate) - n).amax() < 1e-11);
    let by_rate = central_difference::<Vector3<f64>, Vector3<f64>, 3, 3>(|w| body.acceleration_rad_s2(w), &rate, 1e-5);
    assert!((by_rate - m).amax() < 1e-9);
    let by_ratios = central_difference::<SVector<f64, 5>, Vector3<f64>, 5, 3>(
        |l| FreeBody::new(&InertiaRatios((*l).into())).unwrap().acceleration_rad_s2(&rate),
        &PAPER.vector(),
        1e-5,
    );
    assert!((by_ratios - n).amax() < 1e-9);
    let expected = [0.696715583, 1.109482306, 1.413802111];
    assert!(PAPER.principal_moments().iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9));
    assert!(PAPER.is_physical() && !InertiaRatios([0.2, 0.2, 0.0, 0.0, 0.0]).is_physical());
}

#[test]
fn motion_is_the_printed_one() {
    let times_s: Vec<f64> = (0..=600).map(f64::from).collect();
    let points = propagate(&at_start(paper_rate()), &PAPER, &times_s).unwrap();
    // Shuster's quaternions, scalar last: the vector part changes its sign.
    let expected = [
        (
            60,
            [0.649734687738, -0.32839425578, -0.348376965468, 0.590453671554],
            [0.519253989963, 2.152258543697, -6.26030457059],
        ),
        (
            600,
            [-0.025368477055, 0.097716333999, -0.180070744049, 0.978459240633],
            [1.629255771355, 3.64362201528, 5.21732795192],
        ),
    ];
    for (k, q, rate) in expected {
        let attitude = UnitQuaternion::from_quaternion(Quaternion::new(q[3], -q[0], -q[1], -q[2]));
        let found = points[k].state;
        assert!(found.asteroid_from_inertial.angle_to(&attitude) < 2e-8, "t = {k}");
        assert!((found.rate_in_asteroid_rad_s - rate_deg_s(rate[0], rate[1], rate[2])).norm() < 1e-9, "t = {k}");
    }
}

#[test]
fn sensitivities_agree_with_differences() {
    let start = UnitQuaternion::from_euler_angles(0.4, -0.9, 2.0);
    let flown = |x: &SVector<f64, 8>| {
        let state =
            SpinState { asteroid_from_inertial: start, rate_in_asteroid_rad_s: x.fixed_rows::<3>(0).into_owned() };
        let inertia = InertiaRatios(x.fixed_rows::<5>(3).into_owned().into());
        propagate(&state, &inertia, &[0.0, 20.0, 47.0]).unwrap().pop().unwrap()
    };
    let mut x = SVector::<f64, 8>::zeros();
    x.fixed_rows_mut::<3>(0).copy_from(&paper_rate());
    x.fixed_rows_mut::<5>(3).copy_from(&PAPER.vector());
    let numeric = central_difference::<_, SpinState, 8, 6>(|x| flown(x).state, &x, 1e-6);
    let analytic = flown(&x).sensitivity;
    assert!((numeric - analytic).amax() < 1e-5 * analytic.amax(), "{numeric}{analytic}");
}

#[test]
fn exact_rotations_give_the_exact_motion() {
    let cases = [
        (paper_rate(), PAPER),
        (rate_deg_s(0.5, 3.0, 1.0), InertiaRatios([0.5, 1.2, 0.05, -0.1, 0.1])),
        (rate_deg_s(2.0, 2.2, -1.3), InertiaRatios([2.5, 2.2, 0.3, 0.4, -0.3])),
    ];
    for (rate, inertia) in cases {
        for config in [using(Estimator::Shooting), using(Estimator::Realtime)] {
            let sequence = simulate(rate, inertia, &design(120.0, 1.0), 0.0, 1);
            let result = run(&sequence, &config);
            assert!(rms(rate_errors_rad_s(&sequence, &result)) < 1e-9);
            assert!(worst_ratio_error(&sequence.inertia, &result.inertia_ratios.unwrap()) < 1e-8);
            assert_eq!((result.pairs_used, result.pairs_rejected), (sequence.pairs.len(), 0));
            assert!(
                result.epochs[70].asteroid_from_inertial.angle_to(&sequence.truth[70].asteroid_from_inertial) < 1e-8
            );
            assert_eq!(result.epochs[0].t_ns, 1_000_000_000);
        }
    }
}

#[test]
fn a_slow_body_seen_rarely_with_gaps_is_found_too() {
    let mut sequence = simulate(paper_rate() * 1e-3, PAPER, &design(120_000.0, 1500.0), 0.0, 1);
    for (i, pair) in sequence.pairs.iter_mut().enumerate() {
        if i % 7 == 3 {
            pair.status = PairStatus::FewMatches;
            pair.camera_to_from_camera_from = UnitQuaternion::identity();
            pair.covariance_rad2 = Matrix3::zeros();
        }
    }
    let result = run(&sequence, &TumblingConfig::default());
    assert!(rms(rate_errors_rad_s(&sequence, &result)) < 1e-12);
    assert!(worst_ratio_error(&PAPER, &result.inertia_ratios.unwrap()) < 1e-8);
}

#[test]
fn shooting_is_consistent_and_reaches_the_bound() {
    let runs = 24;
    let bound = arc_bound(&paper_rate(), &PAPER, &design(60.0, 1.0), 10.0).unwrap();
    let results: Vec<(f64, f64, f64, f64)> = (0..runs)
        .into_par_iter()
        .map(|seed| {
            let sequence = simulate(paper_rate(), PAPER, &design(60.0, 1.0), 1.0, seed);
            let result = run(&sequence, &TumblingConfig::default());
            let ratio = (result.inertia_ratios.unwrap()[1] - PAPER.0[1]) / bound.inertia_sigma.unwrap()[1];
            let rate = rate_errors_rad_s(&sequence, &result)[0];
            (nees_at_end(&sequence, &result) / 6.0, ratio_nees(&PAPER, &result) / 5.0, rate, ratio)
        })
        .collect();
    let mean = |f: fn(&(f64, f64, f64, f64)) -> f64| results.iter().map(f).sum::<f64>() / runs as f64;
    let (state, ratios) = (mean(|r| r.0), mean(|r| r.1));
    assert!(ConsistencyBounds::of_mean(6, runs as usize, 0.99).contains(state), "state NEES {state}");
    assert!(ConsistencyBounds::of_mean(5, runs as usize, 0.99).contains(ratios), "ratio NEES {ratios}");
    let rate_rms = rms(results.iter().map(|r| r.2));
    let rate_bound = bound.rate_sigma_rad_s.unwrap().iter().map(|s| s * s).sum::<f64>().sqrt();
    assert!((0.75..1.25).contains(&(rate_rms / rate_bound)), "rate {rate_rms}, bound {rate_bound}");
    let ratio_rms = rms(results.iter().map(|r| r.3));
    assert!((0.6..1.4).contains(&ratio_rms), "worst ratio over its bound {ratio_rms}");
}

#[test]
fn covariances_stated_too_small_are_seen_and_put_right() {
    let halve = |s: &mut Sequence| s.pairs.iter_mut().for_each(|p| p.covariance_rad2 *= 0.25);
    let bounds = ConsistencyBounds::of_mean(6, 16, 0.99);
    let believing = TumblingConfig { scale_covariance: false, ..TumblingConfig::default() };
    let (state, _) = mean_nees(16, 60.0, &believing, halve);
    assert!(state > bounds.upper, "half the standard deviation must look overconfident: {state}");
    let (state, _) = mean_nees(16, 60.0, &TumblingConfig::default(), halve);
    assert!(bounds.contains(state), "scaled by the residuals: {state}");
}

#[test]
fn realtime_filter_is_consistent() {
    let (state, ratios) = mean_nees(12, 150.0, &using(Estimator::Realtime), |_| ());
    assert!(ConsistencyBounds::of_mean(6, 12, 0.99).contains(state), "state NEES {state}");
    assert!(ConsistencyBounds::of_mean(5, 12, 0.99).contains(ratios), "ratio NEES {ratios}");
}

#[test]
fn pure_spin_invents_no_inertia() {
    // Noise enough that an unguarded fit finds a nutation, and inertia in it, in every third run.
    let mut noisy = design(300.0, 1.0);
    noisy.sigma_rad = 0.3_f64.to_radians();
    let inertia = InertiaRatios([0.85, 1.37, 0.0, 0.0, 0.0]);
    let outcomes: Vec<(usize, bool, f64)> = (0..20)
        .into_par_iter()
        .map(|seed| {
            let config = using(if seed % 5 == 4 { Estimator::Realtime } else { Estimator::Shooting });
            let sequence = simulate(rate_deg_s(0.0, 2.3, 0.0), inertia, &noisy, 1.0, seed);
            let result = run(&sequence, &config);
            let elements = result.epochs[30].inertia.elements;
            // Lxy and Lyz are zero because the spin axis y is a principal one; the rest stays without a number.
            let right = result.inertia_ratios.is_none()
                && [0, 1, 3].iter().all(|&i: &usize| elements[i].is_none())
                && [2, 4].iter().all(|&i: &usize| elements[i].is_some_and(|e| e.abs() < 0.01));
            (result.undetermined.len(), right, rms(rate_errors_rad_s(&sequence, &result)))
        })
        .collect();
    for (directions, right, rate_rms) in outcomes {
        assert!(directions == 3 && right && rate_rms < 0.05_f64.to_radians(), "{directions} {right} {rate_rms}");
    }
}

#[test]
fn undetermined_directions_are_named() {
    let bound =
        arc_bound(&rate_deg_s(0.0, 0.0, 4.0), &InertiaRatios([0.85, 1.37, 0.0, 0.0, 0.0]), &design(60.0, 1.0), 10.0);
    let bound = bound.unwrap();
    let mut names: Vec<_> = bound.undetermined.iter().map(|u| u.name.clone()).collect();
    names.sort();
    assert_eq!(names, ["+1.00 Lxx", "+1.00 Lxy", "+1.00 Lyy"]);
    assert!(bound.inertia_sigma.is_none());
}

#[test]
fn wrong_pairs_are_left_out() {
    let wrong = |i: usize| i % 20 == 7;
    let errors: Vec<(f64, usize, usize)> = (0..8)
        .into_par_iter()
        .map(|seed| {
            let mut sequence = simulate(paper_rate(), PAPER, &design(60.0, 1.0), 1.0, seed);
            let mut random = random_stream(seed, "wrong pairs", 0);
            let count = sequence.pairs.iter().enumerate().filter(|(i, _)| wrong(*i)).count();
            for (_, pair) in sequence.pairs.iter_mut().enumerate().filter(|(i, _)| wrong(*i)) {
                let axis = Vector3::from_fn(|_, _| -> f64 { StandardNormal.sample(&mut random) });
                let error = so3::exp(&(axis.normalize() * 20_f64.to_radians()));
                pair.camera_to_from_camera_from = error * pair.camera_to_from_camera_from;
            }
            let result = run(&sequence, &TumblingConfig::default());
            (nees_at_end(&sequence, &result) / 6.0, result.pairs_rejected, count)
        })
        .collect();
    for (nees, rejected, count) in &errors {
        assert!(*nees < 4.0 && rejected == count, "NEES {nees}, {rejected} of {count} wrong pairs rejected");
    }
}

#[test]
fn transposed_rotations_are_refused() {
    let mut sequence = simulate(paper_rate(), PAPER, &design(60.0, 1.0), 1.0, 1);
    for pair in &mut sequence.pairs {
        pair.camera_to_from_camera_from = pair.camera_to_from_camera_from.inverse();
    }
    let error = estimate(&sequence.pairs, &sequence.times_ns, &TumblingConfig::default()).unwrap_err();
    assert!(matches!(error, TumblingError::NoConsistentMotion { .. }), "{error}");
}

#[test]
fn papers_filter_reaches_its_floor_and_no_more() {
    let mut sequence = simulate(paper_rate(), PAPER, &design(600.0, 1.0), 0.0, 1);
    let euler = run(&sequence, &using(Estimator::Paper));
    let last_fifth = |r: &TumblingResult| rms(rate_errors_rad_s(&sequence, r)[480..].iter().copied()).to_degrees();
    assert!((last_fifth(&euler) - 0.092).abs() < 0.001, "{}", last_fifth(&euler));
    let ratios_at =
        |r: &TumblingResult, k: usize| worst_ratio_error(&PAPER, &r.epochs[k].inertia.elements.map(Option::unwrap));
    assert!(
        ratios_at(&euler, 500) > 0.05 && ratios_at(&euler, 600) < 0.06,
        "{} {}",
        ratios_at(&euler, 500),
        ratios_at(&euler, 600)
    );
    let mut exact = using(Estimator::Paper);
    exact.paper.integration = PaperIntegration::RungeKutta;
    let exact = run(&sequence, &exact);
    assert!(last_fifth(&exact) < 0.5 * last_fifth(&euler), "{}", last_fifth(&exact));
    // A missing neighbour is bridged by a keyframe pair, or by prediction.
    sequence.pairs.retain(|p| p.t_ns_to != sequence.times_ns[300] || p.t_ns_from != sequence.times_ns[299]);
    assert_eq!(run(&sequence, &using(Estimator::Paper)).epochs.len(), 601);
}

#[test]
fn papers_filter_fed_the_transposed_attitude_never_converges() {
    let sequence = simulate(paper_rate(), PAPER, &design(600.0, 1.0), 0.0, 1);
    let mut errors = [Vec::new(), Vec::new()];
    for (transposed, errors) in errors.iter_mut().enumerate() {
        let mut filter = PaperFilter::new(&PaperConfig::default());
        for truth in &sequence.truth[1..] {
            let attitude = truth.asteroid_from_inertial;
            let fed = if transposed == 1 { attitude.inverse() } else { attitude };
            let alive = filter.predict(1.0).and_then(|()| filter.correct(&fed));
            let error = (filter.epoch(0).rate_in_asteroid_rad_s - truth.rate_in_asteroid_rad_s).norm();
            errors.push(if alive.is_some() { error.to_degrees() } else { f64::INFINITY });
        }
    }
    assert!(errors[0][480..].iter().all(|e| *e < 0.5));
    assert!(errors[1][480..].iter().all(|e| *e > 1.0), "{:?}", &errors[1][480..]);
}

#[test]
fn papers_filter_does_not_mind_the_sign_of_a_quaternion() {
    let sequence = simulate(paper_rate(), PAPER, &design(100.0, 1.0), 0.0, 1);
    let mut filters = [PaperFilter::new(&PaperConfig::default()), PaperFilter::new(&PaperConfig::default())];
    for truth in &sequence.truth[1..] {
        let q = truth.asteroid_from_inertial;
        for (filter, fed) in filters.iter_mut().zip([q, UnitQuaternion::new_unchecked(-q.into_inner())]) {
            filter.predict(1.0).unwrap();
            filter.correct(&fed).unwrap();
        }
        let [a, b] = filters.each_ref().map(|f| f.epoch(0).state());
        assert!(a.minus(&b).norm() < 1e-12);
    }
}

#[test]
fn shooting_beats_the_papers_filter_on_noisy_rotations() {
    let sequence = simulate(paper_rate(), PAPER, &design(300.0, 1.0), 1.0, 5);
    let error = |estimator| {
        let result = run(&sequence, &using(estimator));
        let rate = rms(rate_errors_rad_s(&sequence, &result)[240..].iter().copied());
        (rate.to_degrees(), worst_ratio_error(&PAPER, &result.inertia_ratios.unwrap()))
    };
    let (paper, shooting) = (error(Estimator::Paper), error(Estimator::Shooting));
    assert!(shooting.0 < 0.03 && shooting.0 < 0.25 * paper.0, "{shooting:?} {paper:?}");
    assert!(shooting.1 < 0.004 && shooting.1 < 0.25 * paper.1, "{shooting:?} {paper:?}");
}

#[test]
fn unusable_input_gives_one_clear_error() {
    let good = simulate(paper_rate(), PAPER, &design(30.0, 1.0), 1.0, 1);
    let config = TumblingConfig::default();
    let refused = |pairs: &[RelativeRotation], times: &[i64], config: &TumblingConfig| {
        estimate(pairs, times, config).unwrap_err().to_string()
    };
    let mut none = good.pairs.clone();
    none.iter_mut().skip(4).for_each(|p| p.status = PairStatus::Rejected);
    assert!(refused(&none, &good.times_ns, &config).contains("4 of"));
    assert!(refused(&[], &good.times_ns, &config).contains("0 of 0 image pairs"));
    let mut late = good.pairs.clone();
    late[3].t_ns_to += 1;
    assert!(refused(&late, &good.times_ns, &config).contains("same sequence"));
    let mut reversed = good.pairs.clone();
    reversed[3].t_ns_to = reversed[3].t_ns_from;
    assert!(refused(&reversed, &good.times_ns, &config).contains("earlier picture"));
    let mut nan = good.pairs.clone();
    nan[5].camera_to_from_camera_from = UnitQuaternion::new_unchecked(Quaternion::new(f64::NAN, 0.0, 0.0, 0.0));
    assert!(refused(&nan, &good.times_ns, &config).contains("unit quaternion"));
    let mut flat = good.pairs.clone();
    flat[5].covariance_rad2[(1, 1)] = 0.0;
    assert!(refused(&flat, &good.times_ns, &config).contains("positive definite"));
    flat[5].covariance_rad2[(1, 1)] = f64::NAN;
    assert!(refused(&flat, &good.times_ns, &config).contains("finite"));
    let mut times = good.times_ns.clone();
    times.swap(3, 4);
    assert!(refused(&good.pairs, &times, &config).contains("31 pictures"));
    let wrong = TumblingConfig { growth: 1.0, ..config };
    assert!(refused(&good.pairs, &good.times_ns, &wrong).contains("growth is 1"));
    assert!(toml::from_str::<TumblingConfig>("first_arc = 3.0").is_err());
    assert_eq!(toml::from_str::<TumblingConfig>("estimator = 'realtime'").unwrap().estimator, Estimator::Realtime);
}

#[test]
fn files_hold_every_picture_and_no_invented_number() {
    let folder = tempfile::tempdir().unwrap();
    let sequence = simulate(paper_rate(), PAPER, &design(60.0, 1.0), 1.0, 1);
    let result = run(&sequence, &TumblingConfig::default());
    let (estimate_csv, covariance_csv) = (folder.path().join("estimate.csv"), folder.path().join("covariance.csv"));
    write_estimate_csv(&estimate_csv, &result).unwrap();
    write_covariance_csv(&covariance_csv, &result).unwrap();
    let table = read_timed_table(&estimate_csv, 23).unwrap();
    assert_eq!((table.rows.len(), table.columns[0].as_str(), table.columns[22].as_str()), (61, "qw", "sigma_Lyz"));
    assert_eq!(table.rows[7].values[7..12], result.inertia_ratios.unwrap());
    assert_eq!(table.rows[7].values[4], result.epochs[7].rate_in_asteroid_rad_s.x);
    let table = read_timed_table(&covariance_csv, 21).unwrap();
    assert_eq!(table.columns[6], "c_ay_ay");
    assert_eq!(table.rows[9].values[6], result.epochs[9].covariance[(1, 1)]);
    let spin =
        simulate(rate_deg_s(0.0, 4.0, 0.0), InertiaRatios([0.85, 1.37, 0.0, 0.0, 0.0]), &design(60.0, 1.0), 1.0, 1);
    write_estimate_csv(&estimate_csv, &run(&spin, &TumblingConfig::default())).unwrap();
    let text = std::fs::read_to_string(&estimate_csv).unwrap();
    assert_eq!(text.lines().nth(1).unwrap().matches("NaN").count(), 6);
}
