//! The extended Kalman filter on manifolds.

use super::{covariance, stream, white};
use nalgebra::{Matrix1, Matrix2, Matrix3, SMatrix, UnitQuaternion, Vector1, Vector2, Vector3};
use opnav::geometry::Manifold;
use opnav::geometry::so3::left_jacobian;
use opnav::navigation::filter::{
    CorrectionOptions, Gate, Innovation, Measurement, QuadraticMoments, correct, correct_linearized, predict,
};
use opnav::stats::Estimate;

const PLAIN: CorrectionOptions = CorrectionOptions { gate: None, iterations: 1, second_order: false };

/// `x⁺ = x + P Hᵀ S⁻¹ (z - H x)`, `P⁺ = P - P Hᵀ S⁻¹ H P`, written out.
#[test]
fn a_linear_model_gives_the_closed_kalman_form() {
    let mut random = stream(20);
    for _ in 0..10 {
        let prior = Estimate { state: white::<4>(&mut random) * 100.0, covariance: covariance::<4>(&mut random) };
        let h = SMatrix::<f64, 2, 4>::from_fn(|_, _| white::<1>(&mut random)[0]);
        let measurement = Measurement { value: white::<2>(&mut random) * 100.0, noise: covariance::<2>(&mut random) };
        let p = prior.covariance;
        let gain = p * h.transpose() * (h * p * h.transpose() + measurement.noise).try_inverse().expect("regular");
        let state = prior.state + gain * (measurement.value - h * prior.state);
        let covariance_after = p - gain * h * p;
        for options in [PLAIN, CorrectionOptions { iterations: 4, second_order: true, ..PLAIN }] {
            let after = correct(&prior, &measurement, |x| h * x, &options).expect("regular").estimate;
            assert!((after.state - state).norm() < 1e-6 * state.norm(), "{}", after.state - state);
            assert!((after.covariance - covariance_after).norm() < 1e-6 * covariance_after.norm());
        }
        let f = SMatrix::<f64, 4, 4>::from_fn(|_, _| white::<1>(&mut random)[0]);
        let noise = covariance::<4>(&mut random);
        let moved = predict(&prior, |x| f * x, &noise);
        let expected = f * p * f.transpose() + noise;
        assert!((moved.covariance - expected).norm() < 1e-6 * expected.norm());
        assert!((moved.state - f * prior.state).norm() < 1e-9 * moved.state.norm());
        // The derivative by what is known exactly is not needed.
        let mut known = prior.clone();
        known.covariance.fixed_rows_mut::<1>(2).fill(0.0);
        known.covariance.fixed_columns_mut::<1>(2).fill(0.0);
        let expected = f * known.covariance * f.transpose() + noise;
        assert!((predict(&known, |x| f * x, &noise).covariance - expected).norm() < 1e-6 * expected.norm());
    }
}

/// Directions of two stars bring a prior 2 mrad off to the truth, to second order in the prior's error.
#[test]
fn an_attitude_is_found_from_stars() {
    let truth = UnitQuaternion::from_euler_angles(0.3, -0.8, 1.2);
    let turn = Vector3::new(0.0, 0.0, 0.1);
    let mut estimate = Estimate::from_sigma(truth.plus(&Vector3::new(0.001, -0.001, 0.0014)), &Vector3::repeat(0.002));
    for _ in 0..6 {
        for star in [Vector3::x(), Vector3::z()] {
            let model = |q: &UnitQuaternion<f64>| q.inverse() * star;
            let measurement = Measurement { value: model(&truth), noise: Matrix3::identity() * 1e-12 };
            estimate = correct(&estimate, &measurement, model, &PLAIN).expect("regular").estimate;
        }
    }
    assert!(truth.minus(&estimate.state).norm() < 2e-6);
    let moved = predict(&estimate, |q| q.plus(&turn), &(Matrix3::identity() * 1e-4));
    assert!(truth.plus(&turn).minus(&moved.state).norm() < 2e-6);
    assert!((moved.covariance.trace() - estimate.covariance.trace() - 3e-4).abs() < 1e-9);
}

/// Gradient of the negative logarithm of the posterior by the error at `found`, whose derivative of `found ⊖ prior` is
/// taken by the exact Jacobian of the group.
fn posterior_gradient(
    prior: &Estimate<UnitQuaternion<f64>, 3>,
    found: &UnitQuaternion<f64>,
    z: &Vector3<f64>,
    r: f64,
) -> f64 {
    let shift = found.minus(&prior.state);
    let star = found.inverse() * Vector3::x();
    // found exp(e): star turns by [star×] e, and the shift by J_r⁻¹ e.
    let by_error = star.cross_matrix();
    let inverse = left_jacobian(&-shift).try_inverse().expect("regular");
    let by_prior = inverse.transpose() * prior.covariance.try_inverse().expect("regular") * shift;
    (by_prior - by_error.transpose() * (z - star) / r).norm()
}

/// Half a radian off: the iterated filter stops at the maximum of the posterior, the plain one does not.
#[test]
fn iteration_reaches_the_gauss_newton_optimum_on_the_group() {
    let truth = UnitQuaternion::from_euler_angles(0.3, -0.8, 1.2);
    let prior = Estimate::from_sigma(truth.plus(&Vector3::new(0.3, -0.3, 0.35)), &Vector3::new(0.4, 0.3, 0.5));
    let model = |q: &UnitQuaternion<f64>| q.inverse() * Vector3::x();
    let measurement = Measurement { value: model(&truth), noise: Matrix3::identity() * 1e-3 };
    let gradient = |iterations: usize| {
        let options = CorrectionOptions { iterations, ..PLAIN };
        let found = correct(&prior, &measurement, model, &options).expect("regular").estimate.state;
        posterior_gradient(&prior, &found, &measurement.value, 1e-3)
    };
    assert!(gradient(40) < 1e-4 && gradient(1) > 1.0, "{} {}", gradient(40), gradient(1));
}

#[test]
fn a_gated_measurement_is_an_outcome_that_changes_nothing() {
    let prior = Estimate::from_sigma(Vector2::new(3.0, 4.0), &Vector2::new(0.1, 0.1));
    let range = |x: &Vector2<f64>| Vector1::new(x.norm());
    let at = |value: f64| Measurement { value: Vector1::new(value), noise: Matrix1::new(0.01) };
    let options = CorrectionOptions { gate: Some(Gate { confidence: 0.99 }), ..PLAIN };
    let gated = correct(&prior, &at(6.0), range, &options).expect("regular");
    assert!(!gated.used && gated.estimate == prior);
    assert!((gated.normalized_innovation_squared - 1.0 / 0.02).abs() < 1e-6);
    let used = correct(&prior, &at(5.1), range, &options).expect("regular");
    assert!(used.used && used.estimate != prior);
    let refused = Measurement { noise: Matrix1::new(-1.0), ..at(5.0) };
    assert!(correct(&prior, &refused, range, &options).is_none());
}

/// A range along x: its Hessian is diag(0, 1/d), so that the mean moves by ½ P_yy / d and S grows by ½ (P_yy / d)².
#[test]
fn second_order_terms_are_the_closed_ones() {
    let (d_m, noise) = (10.0, Matrix1::new(0.04));
    let prior = Estimate { state: Vector2::new(d_m, 0.0), covariance: Matrix2::new(1.0, 0.6, 0.6, 9.0) };
    let range = |x: &Vector2<f64>| Vector1::new(x.norm());
    let measurement = Measurement { value: Vector1::new(10.3), noise };
    let found =
        correct(&prior, &measurement, range, &CorrectionOptions { second_order: true, ..PLAIN }).expect("regular");
    let bend = prior.covariance[(1, 1)] / d_m;
    let s = prior.covariance[(0, 0)] + noise[0] + 0.5 * bend * bend;
    let column = prior.covariance.column(0);
    let state = prior.state + column * ((10.3 - d_m - 0.5 * bend) / s);
    assert!((found.estimate.state - state).norm() < 2e-3, "{} {state}", found.estimate.state);
    assert!((found.estimate.covariance - (prior.covariance - column * column.transpose() / s)).norm() < 2e-3);
    let plain = correct(&prior, &measurement, range, &PLAIN).expect("regular");
    assert!((plain.estimate.state - state).norm() > 0.1);
    // An analytic innovation that brings the same terms along gives the same.
    let moments = QuadraticMoments::new(&[Matrix2::new(0.0, 0.0, 0.0, 1.0 / d_m)], &prior.covariance);
    let jacobian = SMatrix::<f64, 1, 2>::new(1.0, 0.0);
    let residual = measurement.value - Vector1::new(d_m) - moments.mean;
    let linearize = |_: &Vector2<f64>| Innovation::<1, 2>::dense(residual, jacobian, noise + moments.covariance);
    let analytic = correct_linearized(&prior, linearize, &PLAIN).expect("regular");
    assert!((analytic.estimate.state - state).norm() < 1e-12);
}

/// Isserlis' theorem, index by index: cov(½xᵀAx, ½xᵀBx) = ¼ Σ A_ab B_cd (P_ac P_bd + P_ad P_bc).
#[test]
fn quadratic_moments_follow_isserlis() {
    let mut random = stream(21);
    let p = covariance::<4>(&mut random);
    let hessians: [SMatrix<f64, 4, 4>; 3] = std::array::from_fn(|_| {
        let root = SMatrix::<f64, 4, 4>::from_fn(|_, _| white::<1>(&mut random)[0]);
        root + root.transpose()
    });
    let moments = QuadraticMoments::new(&hessians, &p);
    for (i, a) in hessians.iter().enumerate() {
        let mean: f64 = (0..16).map(|k| 0.5 * a[k] * p[k]).sum();
        assert!((moments.mean[i] - mean).abs() < 1e-10);
        for (j, b) in hessians.iter().enumerate() {
            let term = |k: usize| {
                let [w, x, y, z] = [k / 64, k / 16 % 4, k / 4 % 4, k % 4];
                0.25 * a[(w, x)] * b[(y, z)] * (p[(w, y)] * p[(x, z)] + p[(w, z)] * p[(x, y)])
            };
            let expected: f64 = (0..256).map(term).sum();
            assert!((moments.covariance[(i, j)] - expected).abs() < 1e-9, "{i} {j}");
        }
    }
}
