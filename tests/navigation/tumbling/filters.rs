//! The filter in real time, and that of the paper as the baseline.

use super::simulated::{design, mean_nees, rate_errors_rad_s, rms, run, simulate, using, worst_ratio_error};
use crate::reference_body::{RATIOS, rate_rad_s};
use nalgebra::UnitQuaternion;
use opnav::geometry::Manifold;
use opnav::navigation::tumbling::*;
use opnav::stats::ConsistencyBounds;

#[test]
fn realtime_filter_is_consistent() {
    let (state, ratios) = mean_nees(12, 150.0, &using(Estimator::Realtime), |_| ());
    assert!(ConsistencyBounds::of_mean(6, 12, 0.99).contains(state), "state NEES {state}");
    assert!(ConsistencyBounds::of_mean(5, 12, 0.99).contains(ratios), "ratio NEES {ratios}");
}

#[test]
fn papers_filter_reaches_its_floor_and_no_more() {
    let mut sequence = simulate(rate_rad_s(), RATIOS, &design(600.0, 1.0), 0.0, 1);
    let euler = run(&sequence, &using(Estimator::Paper));
    let last_fifth = |r: &TumblingResult| rms(rate_errors_rad_s(&sequence, r)[480..].iter().copied()).to_degrees();
    assert!((last_fifth(&euler) - 0.092).abs() < 0.001, "{}", last_fifth(&euler));
    let ratios_at =
        |r: &TumblingResult, k: usize| worst_ratio_error(&RATIOS, &r.epochs[k].inertia.elements.map(Option::unwrap));
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
    let sequence = simulate(rate_rad_s(), RATIOS, &design(600.0, 1.0), 0.0, 1);
    let mut errors = [Vec::new(), Vec::new()];
    for (transposed, errors) in errors.iter_mut().enumerate() {
        let mut filter = PaperFilter::new(&PaperConfig::default());
        for truth in &sequence.truth[1..] {
            let attitude = truth.asteroid_from_inertial;
            let fed = if transposed == 1 { attitude.inverse() } else { attitude };
            let after = filter.predict(1.0).and_then(|moved| moved.correct(&fed));
            let alive = after.is_some();
            filter = after.map_or(filter, |(corrected, _)| corrected);
            let error = (filter.epoch(0).rate_in_asteroid_rad_s - truth.rate_in_asteroid_rad_s).norm();
            errors.push(if alive { error.to_degrees() } else { f64::INFINITY });
        }
    }
    assert!(errors[0][480..].iter().all(|e| *e < 0.5));
    assert!(errors[1][480..].iter().all(|e| *e > 1.0), "{:?}", &errors[1][480..]);
}

#[test]
fn papers_filter_does_not_mind_the_sign_of_a_quaternion() {
    let sequence = simulate(rate_rad_s(), RATIOS, &design(100.0, 1.0), 0.0, 1);
    let mut filters = [PaperFilter::new(&PaperConfig::default()), PaperFilter::new(&PaperConfig::default())];
    for truth in &sequence.truth[1..] {
        let q = truth.asteroid_from_inertial;
        for (filter, fed) in filters.iter_mut().zip([q, UnitQuaternion::new_unchecked(-q.into_inner())]) {
            *filter = filter.predict(1.0).unwrap().correct(&fed).unwrap().0;
        }
        let [a, b] = filters.each_ref().map(|f| f.epoch(0).state());
        assert!(a.minus(&b).norm() < 1e-12);
    }
}

#[test]
fn shooting_beats_the_papers_filter_on_noisy_rotations() {
    let sequence = simulate(rate_rad_s(), RATIOS, &design(300.0, 1.0), 1.0, 5);
    let error = |estimator| {
        let result = run(&sequence, &using(estimator));
        let rate = rms(rate_errors_rad_s(&sequence, &result)[240..].iter().copied());
        (rate.to_degrees(), worst_ratio_error(&RATIOS, &result.inertia_ratios.unwrap()))
    };
    let (paper, shooting) = (error(Estimator::Paper), error(Estimator::Shooting));
    assert!(shooting.0 < 0.03 && shooting.0 < 0.25 * paper.0, "{shooting:?} {paper:?}");
    assert!(shooting.1 < 0.004 && shooting.1 < 0.25 * paper.1, "{shooting:?} {paper:?}");
}
