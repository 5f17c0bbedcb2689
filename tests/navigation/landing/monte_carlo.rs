//! The reference Monte Carlo: bearings once a second, initial errors of ±1000 m, ±10 m/s, ±2°. The numbers are those of
//! the audited reference simulation of 300 runs.

use super::reference_run::{Case, Epoch, Mistake, REFERENCE, fly};
use opnav::navigation::landing::FilterKind;
use opnav::navigation::landmark::Selector;
use opnav::stats::ConsistencyBounds;
use rayon::prelude::*;
use std::sync::LazyLock;

const RUNS: u64 = 100;

static REFERENCE_RUNS: LazyLock<Vec<Vec<Epoch>>> = LazyLock::new(|| fly_all(&REFERENCE, RUNS));

fn fly_all(case: &Case, runs: u64) -> Vec<Vec<Epoch>> {
    (0..runs).into_par_iter().map(|run| fly(case, run)).collect()
}

fn rms(runs: &[Vec<Epoch>], second: usize, component: usize) -> f64 {
    (runs.iter().map(|r| r[second].error[component].powi(2)).sum::<f64>() / runs.len() as f64).sqrt()
}

/// 1σ by the filter, root mean square over the runs.
fn believed(runs: &[Vec<Epoch>], second: usize, component: usize) -> f64 {
    (runs.iter().map(|r| r[second].covariance[(component, component)]).sum::<f64>() / runs.len() as f64).sqrt()
}

fn mean_nees(runs: &[Vec<Epoch>], second: usize) -> f64 {
    runs.iter().map(|r| r[second].nees()).sum::<f64>() / runs.len() as f64
}

fn overall_nees(runs: &[Vec<Epoch>]) -> f64 {
    (30..=182).map(|second| mean_nees(runs, second)).sum::<f64>() / 153.0
}

fn converged(runs: &[Vec<Epoch>]) -> usize {
    runs.iter().filter(|r| r.last().is_some_and(Epoch::converged)).count()
}

#[test]
fn hybrid_filter_lands_as_the_reference_does() {
    let runs = &*REFERENCE_RUNS;
    assert_eq!(converged(runs), RUNS as usize);
    let horizontal_m = 3.0 * (0.5 * (rms(runs, 198, 0).powi(2) + rms(runs, 198, 1).powi(2))).sqrt();
    assert!((horizontal_m / 0.106 - 1.0).abs() < 0.15, "horizontal 3 rms {horizontal_m} m");
    let z_m = 3.0 * believed(runs, 198, 2);
    assert!((z_m / 4.53 - 1.0).abs() < 0.05, "z 3 sigma {z_m} m");
    for (component, reference_deg) in [(6, 0.024), (7, 0.012)] {
        let tilt_deg = 3.0 * rms(runs, 198, component).to_degrees();
        assert!((tilt_deg / reference_deg - 1.0).abs() < 0.25, "tilt {component}: 3 rms {tilt_deg}°");
    }
    for second in [60, 120, 182, 198] {
        let yaw_deg = believed(runs, second, 8).to_degrees();
        assert!((1.07..=1.09).contains(&yaw_deg), "yaw sigma {yaw_deg}° at {second} s");
    }
}

#[test]
fn hybrid_filter_is_consistent_all_the_way() {
    let runs = &*REFERENCE_RUNS;
    let bounds = ConsistencyBounds::of_mean(9, RUNS as usize, 0.9999);
    for second in 30..=182 {
        let nees = mean_nees(runs, second);
        assert!(bounds.contains(nees), "NEES {nees} at {second} s, bounds {bounds:?}");
    }
    let nees = overall_nees(runs);
    assert!((0.9..1.1).contains(&nees), "NEES {nees}");
}

/// Errors sit on the posterior Cramér–Rao bound of the reference.
#[test]
fn hybrid_filter_sits_on_the_bound() {
    let runs = &*REFERENCE_RUNS;
    let bounds_m = [
        (60, [55.5, 63.5, 87.6]),
        (120, [10.2, 7.86, 18.8]),
        (182, [0.122, 0.253, 3.93]),
        (198, [0.0334, 0.0312, 1.49]),
    ];
    for (second, bound_m) in bounds_m {
        for (component, bound) in bound_m.iter().enumerate() {
            let ratio = rms(runs, second, component) / bound;
            assert!((0.8..1.25).contains(&ratio), "component {component} at {second} s: {ratio} of the bound");
        }
    }
}

#[test]
fn rivals_land_as_well() {
    let z_m = |selector: Selector| {
        let runs = fly_all(&Case { selector, ..REFERENCE }, 30);
        assert_eq!(converged(&runs), 30, "{selector:?}");
        3.0 * believed(&runs, 198, 2)
    };
    for (selector, reference_m) in [(Selector::Svd, 5.2), (Selector::Condition, 5.2)] {
        let found_m = z_m(selector);
        assert!((found_m / reference_m - 1.0).abs() < 0.1, "{selector:?}: z 3 sigma {found_m} m");
    }
    assert!(z_m(Selector::Random) < 4.0);
    assert!((z_m(Selector::None) / 18.2 - 1.0).abs() < 0.1);
}

/// Five unknown landmarks at a time bring z down.
#[test]
fn more_landmarks_are_better() {
    let runs = fly_all(&Case { landmarks: 5, ..REFERENCE }, 30);
    assert_eq!(converged(&runs), 30);
    let z_m = 3.0 * believed(&runs, 198, 2);
    assert!((1.2..2.5).contains(&z_m), "z 3 sigma {z_m} m");
    assert!((0.8..1.2).contains(&overall_nees(&runs)));
}

/// The paper's own error state is overconfident, and most so in yaw, which nothing observes.
#[test]
fn standard_filter_is_inconsistent() {
    let runs = fly_all(&Case { kind: FilterKind::Standard, ..REFERENCE }, 50);
    assert!(overall_nees(&runs) > 5.0, "NEES {}", overall_nees(&runs));
    assert!(believed(&runs, 198, 8).to_degrees() < 0.4);
    assert!(converged(&runs) >= 40);
}

/// Negative control: equations (8) and (9) with the paper's printed signs of g land nobody.
#[test]
fn printed_signs_of_gravity_never_converge() {
    let case = Case { kind: FilterKind::Standard, mistake: Mistake::PrintedSigns, ..REFERENCE };
    assert_eq!(converged(&fly_all(&case, 30)), 0);
}

/// Negative control: a landmark's prior without its correlations with the state is wrong, and NEES shows it.
#[test]
fn uncorrelated_landmark_prior_is_inconsistent() {
    let case = Case { mistake: Mistake::UncorrelatedLandmark, ..REFERENCE };
    assert!(overall_nees(&fly_all(&case, 30)) > 10.0);
}
