//! Tests of the room `navigation::filter`.

use nalgebra::{DMatrix, DVector, Matrix3, UnitQuaternion, Vector2, Vector3};
use opnav::geometry::Manifold;
use opnav::navigation::filter::{Gate, Innovation, Measurement, correct, correction, iterated_correction, predict};
use opnav::stats::Estimate;

fn prior() -> DMatrix<f64> {
    DMatrix::from_row_slice(3, 3, &[4.0, 1.0, 0.5, 1.0, 3.0, -0.2, 0.5, -0.2, 2.0])
}

fn innovation() -> Innovation {
    Innovation {
        residual: DVector::from_vec(vec![1.0, -2.0]),
        jacobian: DMatrix::from_row_slice(2, 3, &[1.0, 0.0, 2.0, 0.3, -1.0, 0.0]),
        noise: DMatrix::from_diagonal(&DVector::from_vec(vec![0.5, 0.1])),
    }
}

/// The information form is a second road to the same posterior.
#[test]
fn correction_agrees_with_the_information_form() {
    let (p, i) = (prior(), innovation());
    let c = correction(&p, &i).expect("a regular problem");
    let weight = i.jacobian.transpose() * i.noise.clone().try_inverse().expect("regular");
    let information = p.clone().try_inverse().expect("regular") + &weight * &i.jacobian;
    let covariance = information.try_inverse().expect("regular");
    let shift = &covariance * weight * &i.residual;
    assert!((&c.covariance - covariance).norm() < 1e-12);
    assert!((c.shift - shift).norm() < 1e-12);
    assert_eq!(c.covariance, c.covariance.transpose());
}

#[test]
fn stacking_equals_one_after_the_other() {
    let (p, i) = (prior(), innovation());
    let rows = |row: usize| Innovation {
        residual: i.residual.rows(row, 1).into_owned(),
        jacobian: i.jacobian.rows(row, 1).into_owned(),
        noise: i.noise.view((row, row), (1, 1)).into_owned(),
    };
    let stacked = Innovation::stacked(&[rows(0), rows(1)]).expect("two parts");
    assert_eq!(stacked, i);
    let first = correction(&p, &rows(0)).expect("regular");
    let mut second = rows(1);
    second.residual -= &second.jacobian * &first.shift;
    let then = correction(&first.covariance, &second).expect("regular");
    let both = correction(&p, &stacked).expect("regular");
    assert!((then.covariance - both.covariance).norm() < 1e-12);
    assert!((first.shift + then.shift - both.shift).norm() < 1e-12);
    assert!(Innovation::stacked(&[]).is_none());
}

/// A range of (3, 4) m from a prior 1 m off: iteration reaches the maximum of the posterior, where its gradient is 0.
#[test]
fn iteration_reaches_the_maximum_a_posteriori() {
    let p = DMatrix::identity(2, 2);
    let at = |d: &DVector<f64>| Vector2::new(3.0 + d[0], 4.0 + d[1]);
    let linearize = |d: &DVector<f64>| Innovation {
        residual: DVector::from_element(1, 3.0 - at(d).norm()),
        jacobian: DMatrix::from_row_slice(1, 2, at(d).normalize().as_slice()),
        noise: DMatrix::from_element(1, 1, 1e-4),
    };
    let c = iterated_correction(&p, 8, linearize).expect("regular");
    let i = linearize(&c.shift);
    let gradient = &c.shift - i.jacobian.transpose() * (i.residual / 1e-4);
    assert!(gradient.norm() < 1e-6, "gradient {gradient}");
}

#[test]
fn gate_passes_at_the_chi_squared_quantile() {
    let gate = Gate { confidence: 0.99 };
    assert!(gate.passes(9.20, 2));
    assert!(!gate.passes(9.22, 2));
    let indefinite = Innovation { noise: DMatrix::identity(2, 2) * -100.0, ..innovation() };
    assert_eq!(indefinite.normalized_squared(&prior()), None);
}

/// An attitude filter: directions of two stars bring a prior 2 mrad off to the truth, to second order in the prior's error.
#[test]
fn manifold_filter_finds_an_attitude() {
    let truth = UnitQuaternion::from_euler_angles(0.3, -0.8, 1.2);
    let turn = Vector3::new(0.0, 0.0, 0.1);
    let start = Estimate::from_sigma(truth.plus(&Vector3::new(0.001, -0.001, 0.0014)), &Vector3::repeat(0.002));
    let mut estimate = start.clone();
    for _ in 0..6 {
        for star in [Vector3::x(), Vector3::z()] {
            let model = |q: &UnitQuaternion<f64>| q.inverse() * star;
            let measurement = Measurement { value: model(&truth), noise: Matrix3::identity() * 1e-12 };
            estimate = correct(&estimate, &measurement, model, 1e-6).expect("regular").0;
        }
    }
    assert!(truth.minus(&estimate.state).norm() < 2e-6);
    let moved = predict(&estimate, |q| q.plus(&turn), &(Matrix3::identity() * 1e-4), 1e-6);
    assert!(truth.plus(&turn).minus(&moved.state).norm() < 2e-6);
    let grown = moved.covariance.trace() - estimate.covariance.trace();
    assert!((grown - 3e-4).abs() < 1e-9);
}
