//! Whether errors agree with their covariances: what does is called consistent, and what does not is noticed.

use super::bench::{
    Bench, covariance_csv, covariance_root, figure, landing_bench, landing_csv, perfect_landing, white,
};
use nalgebra::{SMatrix, SVector, UnitQuaternion, Vector3};
use opnav::evaluation::*;
use opnav::geometry::so3::exp;
use opnav::stats::ConsistencyBounds;

/// Errors drawn from the covariance that is handed in, every epoch independent; `scale` spoils the covariance.
pub fn landing_with_noise(scale: f64) -> Bench {
    let bench = landing_bench();
    let root = covariance_root::<9>(|i| [2.0, 1.0, 4.0, 0.1, 0.2, 0.05, 1e-3, 2e-3, 3e-2][i]);
    let mut rows = perfect_landing();
    for (k, row) in rows.iter_mut().enumerate() {
        let error = root * white::<9>(k as u64);
        row.pose.translation.vector -= error.fixed_rows::<3>(0);
        row.velocity -= error.fixed_rows::<3>(3);
        row.pose.rotation = exp(&-Vector3::from(error.fixed_rows::<3>(6))) * row.pose.rotation;
    }
    bench.put("estimate.csv", &landing_csv(&rows));
    let covariance = root * root.transpose() * scale;
    bench.put("covariance.csv", &covariance_csv(rows.iter().map(|row| (row.t_ns, covariance))));
    bench
}

#[test]
fn errors_drawn_from_the_covariance_are_called_consistent() {
    let metrics = landing_with_noise(1.0).metrics();
    let nees = metrics.figures.iter().find(|f| f.name == "nees_per_dof_mean").expect("NEES");
    let bound = nees.bound.expect("bounds");
    assert!(bound.contains(nees.value), "{nees:?}");
    assert!((nees.value - 1.0).abs() < 0.15, "{nees:?}");
    assert!(figure(&metrics, "nees_effective_samples") > 70.0, "independent epochs count in full");
    assert!(figure(&metrics, "nees_share_within_95") > 0.88);
    assert!(metrics.verdict("consistent").expect("a verdict").holds);
    let curve = metrics.series("nees_per_dof").expect("a curve");
    assert_eq!(curve.bound, Some(ConsistencyBounds::of_mean(9, 1, 0.95)));
    assert_eq!(curve.values.len(), 101);
}

#[test]
fn the_sigma_of_roll_pitch_and_yaw_follow_from_the_covariance_in_site_axes() {
    let bench = landing_bench();
    let mut rows = perfect_landing();
    let turned = UnitQuaternion::from_euler_angles(0.3, 0.0, std::f64::consts::FRAC_PI_2);
    rows[7].pose.rotation = turned;
    bench.put("estimate.csv", &landing_csv(&rows));
    let sigma = SVector::<f64, 9>::from_iterator([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 0.01, 0.02, 0.03]);
    let covariance = SMatrix::<f64, 9, 9>::from_diagonal(&sigma.component_mul(&sigma));
    bench.put("covariance.csv", &covariance_csv(rows.iter().map(|row| (row.t_ns, covariance))));
    let metrics = bench.metrics();
    // A lander that heads along the site's y rolls about y and pitches about -x.
    for (name, expected) in [("roll_error", 0.02f64), ("pitch_error", 0.01), ("yaw_error", 0.03)] {
        let found = metrics.series(name).expect("a curve").sigma[7];
        assert!((found - expected.to_degrees()).abs() < 1e-9, "{name}: {found}");
    }
    for (name, expected) in [("position_error_z", 3.0), ("velocity_error_x", 4.0), ("velocity_error_z", 6.0)] {
        assert_eq!(metrics.series(name).expect("a curve").sigma[7], expected, "{name}");
    }
}

#[test]
fn a_wrong_covariance_is_noticed_on_either_side() {
    for (scale, word) in [(0.5, "overconfident"), (2.0, "pessimistic")] {
        let verdict = landing_with_noise(scale).metrics().verdict("consistent").expect("a verdict").clone();
        assert!(!verdict.holds && verdict.reason.contains(word), "{scale}: {verdict:?}");
    }
}

#[test]
fn errors_that_persist_count_as_few_samples() {
    let one = white::<3>(0);
    let sample = |t: usize, whitened| NormalizedSample { t_s: t as f64, whitened };
    let constant: Vec<_> = (0..300).map(|t| sample(t, one)).collect();
    assert!(effective_samples(&constant) < 2.0);
    let independent: Vec<_> = (0..300).map(|t| sample(t, white::<3>(t as u64))).collect();
    assert!(effective_samples(&independent) > 250.0);
    // An autoregression of coefficient a has ρ_k = a^k, hence n (1 - a²)/(1 + a²) samples.
    let a: f64 = 0.9;
    let mut state = white::<3>(0);
    let walk: Vec<_> = (0..20_000)
        .map(|t| {
            state = state * a + white::<3>(t as u64 + 1) * (1.0 - a * a).sqrt();
            sample(t, state)
        })
        .collect();
    // Of 20 000 samples every tenth is kept, whose autoregression has the coefficient a^10.
    let squared = a.powi(20);
    let expected = 2000.0 * (1.0 - squared) / (1.0 + squared);
    let found = effective_samples(&walk);
    assert!((found / expected - 1.0).abs() < 0.1, "{found} for {expected}");
}

#[test]
fn a_covariance_that_is_not_positive_definite_is_reported() {
    let bench = landing_bench();
    let rows = perfect_landing();
    bench.put("estimate.csv", &landing_csv(&rows));
    bench.put("covariance.csv", &covariance_csv(rows.iter().map(|row| (row.t_ns, SMatrix::<f64, 9, 9>::zeros()))));
    let metrics = bench.metrics();
    assert_eq!(metrics.figure("nees_per_dof_mean"), None);
    assert!(metrics.notes.iter().any(|n| n.contains("positive definite")), "{:?}", metrics.notes);
}
