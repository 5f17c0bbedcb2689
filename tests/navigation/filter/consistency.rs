//! Are the filters' covariances what their errors are? Over many runs, and with a control that must fail.

use super::{stream, white};
use nalgebra::{Matrix3, SVector, UnitQuaternion, Vector3};
use opnav::geometry::Manifold;
use opnav::navigation::filter::{
    CorrectionOptions, Measurement, SigmaPoints, UnscentedOptions, correct, predict, unscented_correct,
    unscented_predict,
};
use opnav::stats::{ConsistencyBounds, Estimate, normalized_error_squared};

const RUNS: u64 = 300;
const STEPS: usize = 25;
const SIGMA_START_RAD: f64 = 0.3;
const SIGMA_WALK_RAD: f64 = 0.02;
const SIGMA_STAR: f64 = 0.05;

type Attitude = Estimate<UnitQuaternion<f64>, 3>;

/// A tumbling star camera: turns known but for a random walk, one star's direction a step.
fn mean_nees(step: impl Fn(Attitude, &Vector3<f64>, &Vector3<f64>, &Vector3<f64>) -> Attitude) -> f64 {
    let total: f64 = (0..RUNS)
        .map(|run| {
            let mut random = stream(1000 + run);
            let start = UnitQuaternion::from_scaled_axis(white::<3>(&mut random));
            let mut truth = start.plus(&(white::<3>(&mut random) * SIGMA_START_RAD));
            let mut estimate = Estimate::from_sigma(start, &Vector3::repeat(SIGMA_START_RAD));
            for k in 0..STEPS {
                let turn = Vector3::new(0.2, 0.1 * (k as f64).sin(), -0.15);
                truth = truth.plus(&turn).plus(&(white::<3>(&mut random) * SIGMA_WALK_RAD));
                let star = [Vector3::x(), Vector3::y(), Vector3::z()][k % 3];
                let seen = truth.inverse() * star + white::<3>(&mut random) * SIGMA_STAR;
                estimate = step(estimate, &turn, &star, &seen);
            }
            let error: SVector<f64, 3> = truth.minus(&estimate.state);
            normalized_error_squared(&error, &estimate.covariance).expect("definite")
        })
        .sum();
    total / (3 * RUNS) as f64
}

fn walk() -> Matrix3<f64> {
    Matrix3::identity() * SIGMA_WALK_RAD.powi(2)
}

fn extended(stated_sigma: f64) -> f64 {
    mean_nees(|estimate, turn, star, seen| {
        let moved = predict(&estimate, |q| q.plus(turn), &walk());
        let measurement = Measurement { value: *seen, noise: Matrix3::identity() * stated_sigma.powi(2) };
        let model = |q: &UnitQuaternion<f64>| q.inverse() * star;
        let options = CorrectionOptions { iterations: 3, ..CorrectionOptions::default() };
        correct(&moved, &measurement, model, &options).expect("definite").estimate
    })
}

fn unscented(stated_sigma: f64) -> f64 {
    mean_nees(|estimate, turn, star, seen| {
        let points = SigmaPoints::default();
        let moved = unscented_predict(&estimate, |q| q.plus(turn), &walk(), &points).expect("definite");
        let measurement = Measurement { value: *seen, noise: Matrix3::identity() * stated_sigma.powi(2) };
        let model = |q: &UnitQuaternion<f64>| q.inverse() * star;
        unscented_correct(&moved, &measurement, model, &UnscentedOptions::default()).expect("definite").estimate
    })
}

#[test]
fn filters_are_consistent_and_one_that_is_told_wrong_is_not() {
    let bounds = ConsistencyBounds::of_mean(3, RUNS as usize, 0.999);
    for (name, filter) in [("extended", extended as fn(f64) -> f64), ("unscented", unscented)] {
        let honest = filter(SIGMA_STAR);
        assert!(bounds.contains(honest), "{name}: {honest} outside {bounds:?}");
        let told_wrong = filter(0.5 * SIGMA_STAR);
        assert!(told_wrong > bounds.upper, "{name}: {told_wrong}");
    }
}
