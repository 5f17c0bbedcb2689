//! The one correction: against the information form, for fixed and growing covariances, dense and sparse Jacobians.

use super::{covariance, least_eigenvalue, stream, white};
use nalgebra::{DMatrix, Matrix1, Matrix2, SMatrix, SVector, Vector1, Vector2};
use opnav::navigation::filter::{Gate, Innovation, correction, iterated_correction};
use smallvec::smallvec;

type Dense = Innovation<2, 6>;

/// A regular problem; the Jacobian of its second block is 0.
fn problem(seed: u64) -> (SMatrix<f64, 6, 6>, Dense) {
    let mut random = stream(seed);
    let prior = covariance::<6>(&mut random);
    let mut jacobian = SMatrix::<f64, 2, 6>::from_fn(|_, _| white::<1>(&mut random)[0]);
    jacobian.fixed_columns_mut::<2>(2).fill(0.0);
    (prior, Dense::dense(white(&mut random), jacobian, covariance(&mut random)))
}

/// The information form is a second road to the same posterior.
#[test]
fn correction_agrees_with_the_information_form() {
    for seed in 0..20 {
        let (prior, i) = problem(seed);
        let c = correction(prior, std::slice::from_ref(&i)).expect("a regular problem");
        let jacobian = i.jacobian[0].1;
        let weight = jacobian.transpose() * i.noise.try_inverse().expect("regular");
        let information = prior.try_inverse().expect("regular") + weight * jacobian;
        let covariance = information.try_inverse().expect("regular");
        let shift = covariance * weight * i.residual;
        assert!((c.covariance - covariance).norm() < 1e-9 * covariance.norm());
        assert!((SVector::<f64, 6>::from_column_slice(&c.shift) - shift).norm() < 1e-9);
        let s = jacobian * prior * jacobian.transpose() + i.noise;
        let nis = i.residual.dot(&(s.try_inverse().expect("regular") * i.residual));
        assert!((c.normalized_innovation_squared / nis - 1.0).abs() < 1e-9);
        assert!((i.normalized_squared(&prior).expect("definite") / nis - 1.0).abs() < 1e-9);
        // Without the term that it is tested for, the test fails.
        assert!((prior - covariance).norm() > 1e-3 * covariance.norm());
    }
}

#[test]
fn blocks_are_the_dense_jacobian_and_a_growing_covariance_the_fixed_one() {
    let (prior, dense) = problem(3);
    let block = |start: usize| (start, dense.jacobian[0].1.fixed_columns::<2>(start).into_owned());
    let sparse =
        Innovation::<2, 2> { residual: dense.residual, jacobian: smallvec![block(4), block(0)], noise: dense.noise };
    let fixed = correction(prior, std::slice::from_ref(&dense)).expect("regular");
    let growing = correction(DMatrix::from_column_slice(6, 6, prior.as_slice()), &[sparse]).expect("regular");
    let difference = SMatrix::<f64, 6, 6>::from_column_slice(growing.covariance.as_slice()) - fixed.covariance;
    assert!(difference.norm() < 1e-12);
    assert!(growing.shift.iter().zip(&fixed.shift).all(|(a, b)| (a - b).abs() < 1e-12));
    // A block at the wrong column is noticed.
    let wrong = Innovation::<2, 2> {
        residual: dense.residual,
        jacobian: smallvec![block(4), (2, block(0).1)],
        noise: dense.noise,
    };
    let wrong = correction(prior, &[wrong]).expect("regular");
    assert!((wrong.covariance - fixed.covariance).norm() > 1e-3);
}

/// Beyond the size that costs no allocation nothing else changes.
#[test]
fn a_large_state_is_corrected_like_a_small_one() {
    let (prior, dense) = problem(4);
    let small = correction(prior, std::slice::from_ref(&dense)).expect("regular");
    let mut large = DMatrix::identity(150, 150);
    large.view_mut((0, 0), (6, 6)).copy_from(&prior);
    let large = correction(large, &[dense]).expect("regular");
    let corner = large.covariance.fixed_view::<6, 6>(0, 0) - small.covariance;
    assert!(corner.norm() < 1e-12 && large.shift[..6] == small.shift[..] && large.shift.len() == 150);
    assert!(large.covariance.view((6, 6), (144, 144)) == DMatrix::identity(144, 144));
    assert!(large.covariance.view((6, 0), (144, 6)).amax() == 0.0);
}

#[test]
fn one_after_the_other_is_all_at_once() {
    let (prior, both) = problem(5);
    let noise = Matrix2::from_diagonal(&both.noise.diagonal());
    let both = Innovation { noise, ..both };
    let row = |k: usize| {
        let jacobian = both.jacobian[0].1.fixed_rows::<1>(k).into_owned();
        Innovation::<1, 6>::dense(Vector1::new(both.residual[k]), jacobian, Matrix1::new(noise[(k, k)]))
    };
    let once = correction(prior, std::slice::from_ref(&both)).expect("regular");
    let in_turn = correction(prior, &[row(0), row(1)]).expect("regular");
    assert!((once.covariance - in_turn.covariance).norm() < 1e-12);
    assert!(once.shift.iter().zip(&in_turn.shift).all(|(a, b)| (a - b).abs() < 1e-12));
    assert!((once.normalized_innovation_squared - in_turn.normalized_innovation_squared).abs() < 1e-10);
    let nothing = correction::<_, 2, 6>(prior, &[]).expect("nothing to refuse");
    assert_eq!((nothing.covariance, nothing.normalized_innovation_squared), (prior, 0.0));
}

/// Measurements ten million times (in σ) better than the prior: where the short form loses its sign, Joseph's does not.
#[test]
fn josephs_form_stays_symmetric_and_positive() {
    let mut short_failed = 0;
    for seed in 0..20 {
        let mut random = stream(100 + seed);
        let mut joseph = covariance::<6>(&mut random);
        let mut short = joseph;
        for _ in 0..10 {
            let jacobian = SMatrix::<f64, 2, 6>::from_fn(|_, _| white::<1>(&mut random)[0]);
            let noise = Matrix2::identity() * 1e-14;
            let innovation = Innovation::dense(Vector2::zeros(), jacobian, noise);
            joseph = correction(joseph, &[innovation]).expect("definite").covariance;
            assert_eq!(joseph, joseph.transpose());
            let least = least_eigenvalue(&joseph);
            assert!(least > -1e-16 * joseph.norm(), "{least}");
            if let Some(inverse) = (jacobian * short * jacobian.transpose() + noise).try_inverse() {
                short -= short * jacobian.transpose() * inverse * jacobian * short;
            }
        }
        assert!(least_eigenvalue(&joseph) > 0.0);
        short_failed += usize::from(least_eigenvalue(&short) <= 0.0);
    }
    assert!(short_failed >= 5, "the problem is too easy to tell the two apart: {short_failed} of 20");
}

/// A range of (3, 4) m from a prior 1 m off: iteration reaches the maximum of the posterior, where its gradient is 0.
#[test]
fn iteration_reaches_the_maximum_a_posteriori() {
    let at = |d: &[f64]| Vector2::new(3.0 + d[0], 4.0 + d[1]);
    let linearize = |d: &[f64]| {
        let jacobian = at(d).normalize().transpose();
        [Innovation::<1, 2>::dense(Vector1::new(3.0 - at(d).norm()), jacobian, Matrix1::new(1e-4))]
    };
    let gradient = |iterations: usize| {
        let c = iterated_correction(&Matrix2::identity(), iterations, linearize).expect("regular");
        let [i] = linearize(&c.shift);
        (Vector2::from_column_slice(&c.shift) - i.jacobian[0].1.transpose() * (i.residual / 1e-4)).norm()
    };
    assert!(gradient(8) < 1e-6, "gradient {}", gradient(8));
    // A measurement across the prior bends: one step stops short.
    let bent = |d: &[f64]| {
        let x = Vector2::new(3.0 + d[0], 0.5 + d[1]);
        let angle = x.y.atan2(x.x);
        let jacobian = SMatrix::<f64, 1, 2>::new(-x.y, x.x) / x.norm_squared();
        [Innovation::<1, 2>::dense(Vector1::new(1.0 - angle), jacobian, Matrix1::new(1e-4))]
    };
    let gradient = |iterations: usize| {
        let c = iterated_correction(&Matrix2::identity(), iterations, bent).expect("regular");
        let [i] = bent(&c.shift);
        (Vector2::from_column_slice(&c.shift) - i.jacobian[0].1.transpose() * (i.residual / 1e-4)).norm()
    };
    assert!(gradient(1) > 1.0 && gradient(20) < 1e-6, "{} {}", gradient(1), gradient(20));
}

#[test]
fn gate_passes_at_the_chi_squared_quantile() {
    let gate = Gate { confidence: 0.99 };
    assert!(gate.passes(9.20, 2) && !gate.passes(9.22, 2));
    assert!(gate.passes(11.34, 3) && !gate.passes(11.35, 3));
    let (prior, i) = problem(1);
    let indefinite = Innovation { noise: Matrix2::identity() * -1e3, ..i };
    assert_eq!(indefinite.normalized_squared(&prior), None);
    assert_eq!(correction(prior, &[indefinite]), None);
    let three = Innovation::<3, 6>::dense(SVector::zeros(), SMatrix::zeros(), -SMatrix::identity());
    assert_eq!(correction(prior, &[three]), None);
}
