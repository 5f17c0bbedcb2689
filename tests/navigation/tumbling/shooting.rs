//! Shooting over the whole arc: exact, consistent, at its bound, and not led astray.

use super::simulated::{
    Sequence, design, mean_nees, nees_at_end, rate_deg_s, rate_errors_rad_s, ratio_nees, rms, run, simulate, using,
    worst_ratio_error,
};
use crate::reference_body::{RATIOS, rate_rad_s};
use nalgebra::{Matrix3, UnitQuaternion, Vector3};
use opnav::geometry::so3;
use opnav::navigation::tumbling::*;
use opnav::observations::PairStatus;
use opnav::stats::{ConsistencyBounds, random_stream};
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;

#[test]
fn exact_rotations_give_the_exact_motion() {
    let cases = [
        (rate_rad_s(), RATIOS),
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
    let mut sequence = simulate(rate_rad_s() * 1e-3, RATIOS, &design(120_000.0, 1500.0), 0.0, 1);
    for (i, pair) in sequence.pairs.iter_mut().enumerate() {
        if i % 7 == 3 {
            pair.status = PairStatus::FewMatches;
            pair.camera_to_from_camera_from = UnitQuaternion::identity();
            pair.covariance_rad2 = Matrix3::zeros();
        }
    }
    let result = run(&sequence, &TumblingConfig::default());
    assert!(rms(rate_errors_rad_s(&sequence, &result)) < 1e-12);
    assert!(worst_ratio_error(&RATIOS, &result.inertia_ratios.unwrap()) < 1e-8);
}

#[test]
fn shooting_is_consistent_and_reaches_the_bound() {
    let runs = 24;
    let bound = arc_bound(&rate_rad_s(), &RATIOS, &design(60.0, 1.0), 10.0).unwrap();
    let results: Vec<(f64, f64, f64, f64)> = (0..runs)
        .into_par_iter()
        .map(|seed| {
            let sequence = simulate(rate_rad_s(), RATIOS, &design(60.0, 1.0), 1.0, seed);
            let result = run(&sequence, &TumblingConfig::default());
            let ratio = (result.inertia_ratios.unwrap()[1] - RATIOS.0[1]) / bound.inertia_sigma.unwrap()[1];
            let rate = rate_errors_rad_s(&sequence, &result)[0];
            (nees_at_end(&sequence, &result) / 6.0, ratio_nees(&RATIOS, &result) / 5.0, rate, ratio)
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
fn wrong_pairs_are_left_out() {
    let wrong = |i: usize| i % 20 == 7;
    let errors: Vec<(f64, usize, usize)> = (0..8)
        .into_par_iter()
        .map(|seed| {
            let mut sequence = simulate(rate_rad_s(), RATIOS, &design(60.0, 1.0), 1.0, seed);
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
    let mut sequence = simulate(rate_rad_s(), RATIOS, &design(60.0, 1.0), 1.0, 1);
    for pair in &mut sequence.pairs {
        pair.camera_to_from_camera_from = pair.camera_to_from_camera_from.inverse();
    }
    let error = estimate(&sequence.pairs, &sequence.times_ns, &TumblingConfig::default()).unwrap_err();
    assert!(matches!(error, TumblingError::NoConsistentMotion { .. }), "{error}");
}
