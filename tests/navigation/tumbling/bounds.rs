//! What an arc does not determine is named and gets no number.

use super::simulated::{design, rate_deg_s, rate_errors_rad_s, rms, run, simulate, using};
use opnav::navigation::tumbling::*;
use rayon::prelude::*;

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
