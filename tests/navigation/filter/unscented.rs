//! The unscented filter: exact on linear models, close to Monte Carlo on others, at home on manifolds.

use super::{covariance, stream, white};
use nalgebra::{Matrix1, Matrix2, SMatrix, UnitQuaternion, Vector1, Vector2, Vector3};
use opnav::geometry::Manifold;
use opnav::navigation::filter::{
    CorrectionOptions, Gate, Measurement, SigmaPoints, Transformed, UnscentedOptions, correct, predict,
    unscented_correct, unscented_predict, unscented_transform,
};
use opnav::stats::Estimate;

const SPREADS: [SigmaPoints; 3] = [
    SigmaPoints { alpha: 1.0, beta: 2.0, kappa: 0.0 },
    SigmaPoints { alpha: 1.0, beta: 0.0, kappa: 1.0 },
    SigmaPoints { alpha: 1e-2, beta: 2.0, kappa: 0.0 },
];

#[test]
fn a_linear_model_gives_the_extended_filter() {
    let mut random = stream(30);
    for points in SPREADS {
        let prior = Estimate { state: white::<4>(&mut random), covariance: covariance::<4>(&mut random) };
        let h = SMatrix::<f64, 2, 4>::from_fn(|_, _| white::<1>(&mut random)[0]);
        let measurement = Measurement { value: white::<2>(&mut random), noise: covariance::<2>(&mut random) };
        let extended = correct(&prior, &measurement, |x| h * x, &CorrectionOptions::default()).expect("regular");
        let options = UnscentedOptions { points, ..UnscentedOptions::default() };
        let unscented = unscented_correct(&prior, &measurement, |x| h * x, &options).expect("regular");
        let close = |a: &Estimate<_, 4>, b: &Estimate<_, 4>| {
            let state: SMatrix<f64, 4, 1> = a.state - b.state;
            state.norm() < 1e-7 && (a.covariance - b.covariance).norm() < 1e-7 * b.covariance.norm()
        };
        assert!(close(&unscented.estimate, &extended.estimate), "{points:?}");
        let ratio = unscented.normalized_innovation_squared / extended.normalized_innovation_squared;
        assert!((ratio - 1.0).abs() < 1e-7);
        let f = SMatrix::<f64, 4, 4>::from_fn(|_, _| white::<1>(&mut random)[0]);
        let noise = covariance::<4>(&mut random);
        let moved = unscented_predict(&prior, |x| f * x, &noise, &points).expect("definite");
        assert!(close(&moved, &predict(&prior, |x| f * x, &noise)), "{points:?}");
        let through: Transformed<_, 4, 2> = unscented_transform(&prior, |x| h * x, &points).expect("definite");
        assert!((through.cross_covariance - prior.covariance * h.transpose()).norm() < 1e-7);
        // Another model is told from it.
        let other = unscented_correct(&prior, &measurement, |x| h * x * 1.01, &options).expect("regular");
        assert!(!close(&other.estimate, &extended.estimate));
    }
}

/// A bearing of 15° (1σ) at a well known range bends into an arc: mean and covariance against 200 000 draws.
#[test]
fn a_bent_model_gives_what_monte_carlo_gives() {
    let polar = Estimate::from_sigma(Vector2::new(1.0, 0.4), &Vector2::new(0.02, 15f64.to_radians()));
    let cartesian = |x: &Vector2<f64>| Vector2::new(x[0] * x[1].cos(), x[0] * x[1].sin());
    let root = polar.covariance.map(f64::sqrt);
    let mut random = stream(31);
    let drawn: Vec<_> = (0..200_000).map(|_| cartesian(&(polar.state + root * white::<2>(&mut random)))).collect();
    let mean = drawn.iter().sum::<Vector2<f64>>() / drawn.len() as f64;
    let spread = drawn.iter().map(|x| (x - mean) * (x - mean).transpose()).sum::<Matrix2<f64>>() / drawn.len() as f64;
    let found = unscented_transform(&polar, cartesian, &SigmaPoints::default()).expect("definite");
    assert!((found.mean - mean).norm() < 2e-3, "{} {mean}", found.mean);
    assert!((found.covariance - spread).norm() < 0.05 * spread.norm(), "{} {spread}", found.covariance);
    // A linearisation misses the shift of the mean by far.
    assert!((cartesian(&polar.state) - mean).norm() > 0.03);
}

/// Attitudes about a mean close to half a turn, where their rotation vectors have no mean.
#[test]
fn a_mean_of_rotations_lies_among_them() {
    let state = UnitQuaternion::from_scaled_axis(Vector3::new(0.0, 0.0, 3.1));
    let estimate = Estimate::from_sigma(state, &Vector3::new(0.1, 0.2, 0.3));
    let turn = Vector3::new(0.3, -0.1, 0.2);
    let moved = unscented_predict(&estimate, |q| q.plus(&turn), &SMatrix::zeros(), &SigmaPoints::default());
    let moved = moved.expect("definite");
    assert!(moved.state.minus(&state.plus(&turn)).norm() < 1e-12);
    let turned = UnitQuaternion::from_scaled_axis(turn).inverse().to_rotation_matrix();
    let expected = turned.matrix() * estimate.covariance * turned.matrix().transpose();
    assert!((moved.covariance - expected).norm() < 1e-12);
    // Averaging quaternions' vectors instead would leave the group's mean by more than rounding.
    let lopsided = |q: &UnitQuaternion<f64>| q.plus(&Vector3::new(q.minus(&state).x.powi(2), 0.0, 0.0));
    let bent = unscented_predict(&estimate, lopsided, &SMatrix::zeros(), &SigmaPoints::default()).expect("definite");
    assert!((bent.state.minus(&state).x - 0.01).abs() < 1e-3);
}

/// A direction without uncertainty stays without, and is no obstacle.
#[test]
fn exact_knowledge_stays_exact() {
    let mut prior = Estimate::from_sigma(Vector3::new(1.0, 2.0, 3.0), &Vector3::new(0.5, 0.0, 0.25));
    prior.covariance[(0, 2)] = 0.05;
    prior.covariance[(2, 0)] = 0.05;
    let range = |x: &Vector3<f64>| Vector1::new(x.norm());
    let measurement = Measurement { value: Vector1::new(4.0), noise: Matrix1::new(0.01) };
    let after = unscented_correct(&prior, &measurement, range, &UnscentedOptions::default()).expect("regular");
    assert!(after.used && after.estimate.state.y == 2.0 && after.estimate.covariance[(1, 1)] == 0.0);
    assert!(after.estimate.covariance[(0, 0)] < 0.2);
    prior.covariance[(1, 1)] = -0.1;
    assert!(unscented_correct(&prior, &measurement, range, &UnscentedOptions::default()).is_none());
}

#[test]
fn a_gated_measurement_changes_nothing() {
    let prior = Estimate::from_sigma(Vector2::new(3.0, 4.0), &Vector2::new(0.1, 0.1));
    let range = |x: &Vector2<f64>| Vector1::new(x.norm());
    let options = UnscentedOptions { gate: Some(Gate { confidence: 0.99 }), ..UnscentedOptions::default() };
    let at = |value: f64| Measurement { value: Vector1::new(value), noise: Matrix1::new(0.01) };
    let gated = unscented_correct(&prior, &at(6.0), range, &options).expect("regular");
    assert!(!gated.used && gated.estimate == prior);
    assert!(unscented_correct(&prior, &at(5.1), range, &options).expect("regular").used);
}

/// What the state's own filter, the covariance intersection and the unscented filter do, they do without allocation.
#[test]
fn filters_of_fixed_size_do_not_allocate() {
    let prior = Estimate::from_sigma(Vector2::new(3.0, 4.0), &Vector2::new(0.1, 0.1));
    let range = |x: &Vector2<f64>| Vector1::new(x.norm());
    let measurement = Measurement { value: Vector1::new(5.1), noise: Matrix1::new(0.01) };
    let options = CorrectionOptions { iterations: 3, second_order: true, gate: Some(Gate { confidence: 0.99 }) };
    let counted = allocation_counter::measure(|| {
        let a = correct(&prior, &measurement, range, &options).expect("regular");
        let b = unscented_correct(&prior, &measurement, range, &UnscentedOptions::default()).expect("regular");
        std::hint::black_box((a, b));
    });
    assert_eq!(counted.count_total, 0);
    assert!(allocation_counter::measure(|| drop(std::hint::black_box(vec![1]))).count_total > 0);
}
