//! Covariance intersection: known vectors, and conservative whatever the correlation.

use super::{covariance, least_eigenvalue, stream, white};
use nalgebra::{Matrix2, SMatrix, UnitQuaternion, Vector2, Vector3};
use opnav::geometry::Manifold;
use opnav::navigation::filter::{IntersectionWeights, covariance_intersection};
use opnav::stats::Estimate;

const BOTH: [IntersectionWeights; 2] = [IntersectionWeights::InverseTrace, IntersectionWeights::LeastDeterminant];

/// The vector of the design of the linked spacecraft, whose fractions are exact: traces 5 and 4 weigh 4 to 5, and the
/// determinant of the fused information is least covered at 2 to 3.
#[test]
fn known_vectors_are_met() {
    let estimates = [
        Estimate { state: Vector2::zeros(), covariance: Matrix2::new(4.0, 0.0, 0.0, 1.0) },
        Estimate { state: Vector2::new(1.0, 2.0), covariance: Matrix2::new(1.0, 0.5, 0.5, 3.0) },
    ];
    let by_trace = covariance_intersection(&estimates, IntersectionWeights::InverseTrace).expect("definite");
    assert!((by_trace.state - Vector2::new(0.643564, 0.569307)).norm() < 1e-6, "{}", by_trace.state);
    let expected = Matrix2::new(1.425743, 0.222772, 0.222772, 1.581683);
    assert!((by_trace.covariance - expected).norm() < 1e-6, "{}", by_trace.covariance);
    let least = covariance_intersection(&estimates, IntersectionWeights::LeastDeterminant).expect("definite");
    let expected = Matrix2::new(1.36, 0.24, 0.24, 1.66);
    assert!((least.covariance - expected).norm() < 1e-6, "{}", least.covariance);
    assert!(least.covariance.determinant() < by_trace.covariance.determinant());
}

#[test]
fn an_estimate_fused_with_itself_is_itself() {
    let mut random = stream(40);
    let state = UnitQuaternion::from_euler_angles(0.3, -0.8, 2.9);
    let one = Estimate { state, covariance: covariance::<3>(&mut random) * 0.01 };
    for weights in BOTH {
        for count in [1, 2, 5] {
            let fused = covariance_intersection(&vec![one.clone(); count], weights).expect("definite");
            assert!(fused.state.minus(&one.state).norm() < 1e-12);
            assert!((fused.covariance - one.covariance).norm() < 1e-9 * one.covariance.norm());
        }
        let other = Estimate { covariance: one.covariance * 2.0, ..one.clone() };
        let fused = covariance_intersection(&[one.clone(), other], weights).expect("definite");
        assert!((fused.covariance.norm() > one.covariance.norm() * (1.0 - 1e-9)));
        assert_eq!(covariance_intersection::<UnitQuaternion<f64>, 3>(&[], weights), None);
        let broken = Estimate { covariance: -one.covariance, ..one.clone() };
        assert_eq!(covariance_intersection(&[one.clone(), broken], weights), None);
    }
}

/// By how much the stated covariance falls short of the true one, whose errors are correlated as `joint` says: the least
/// eigenvalue of the difference. The weights of each error are read off the fused states, which are linear in them.
fn margin(
    joint: &SMatrix<f64, 9, 9>,
    fuse: impl Fn(&[Estimate<Vector3<f64>, 3>; 3]) -> Estimate<Vector3<f64>, 3>,
) -> f64 {
    let block = |k: usize| joint.fixed_view::<3, 3>(3 * k, 3 * k).into_owned();
    let mut by_errors = SMatrix::<f64, 3, 9>::zeros();
    let mut stated = SMatrix::zeros();
    for column in 0..9 {
        let mut estimates: [Estimate<Vector3<f64>, 3>; 3] =
            std::array::from_fn(|k| Estimate { state: Vector3::zeros(), covariance: block(k) });
        estimates[column / 3].state[column % 3] = 1.0;
        let fused = fuse(&estimates);
        by_errors.set_column(column, &fused.state);
        stated = fused.covariance;
    }
    least_eigenvalue(&(stated - by_errors * joint * by_errors.transpose()))
}

#[test]
fn intersection_is_conservative_under_any_correlation() {
    let mut random = stream(41);
    let naive = |estimates: &[Estimate<Vector3<f64>, 3>; 3]| {
        let inverses = estimates.each_ref().map(|e| e.covariance.try_inverse().expect("regular"));
        let covariance = inverses.iter().sum::<SMatrix<f64, 3, 3>>().try_inverse().expect("regular");
        let pull: Vector3<f64> = estimates.iter().zip(&inverses).map(|(e, inverse)| inverse * e.state).sum();
        Estimate { state: covariance * pull, covariance }
    };
    let mut naive_failed = 0;
    for _ in 0..300 {
        // Few columns make strong correlations.
        let root = SMatrix::<f64, 9, 5>::from_fn(|_, _| white::<1>(&mut random)[0]);
        let joint = root * root.transpose() + SMatrix::identity() * 0.02;
        for weights in BOTH {
            let least = margin(&joint, |e| covariance_intersection(e, weights).expect("definite"));
            assert!(least > -1e-9, "{weights:?} {least}");
        }
        naive_failed += usize::from(margin(&joint, naive) < -1e-3);
    }
    assert!(naive_failed > 200, "fusion as if independent is too confident: {naive_failed} of 300");
}

/// The least determinant of two estimates by a search along the weight.
#[test]
fn least_determinant_is_that_of_a_search() {
    let mut random = stream(42);
    for _ in 0..20 {
        let [a, b] = [covariance::<3>(&mut random), covariance::<3>(&mut random)];
        let inverses = [a, b].map(|p| p.try_inverse().expect("regular"));
        let determinant = |w: f64| 1.0 / (inverses[0] * w + inverses[1] * (1.0 - w)).determinant();
        let searched = (0..=100_000).map(|k| determinant(f64::from(k) * 1e-5)).fold(f64::INFINITY, f64::min);
        let estimates = [a, b].map(|covariance| Estimate { state: Vector3::zeros(), covariance });
        let fused = covariance_intersection(&estimates, IntersectionWeights::LeastDeterminant).expect("definite");
        let found = fused.covariance.determinant();
        assert!((found / searched - 1.0).abs() < 1e-6, "{found} {searched}");
        let by_trace = covariance_intersection(&estimates, IntersectionWeights::InverseTrace).expect("definite");
        assert!(by_trace.covariance.determinant() >= found * (1.0 - 1e-9));
    }
}

#[test]
fn the_order_of_estimates_does_not_matter() {
    let mut random = stream(43);
    let mean = UnitQuaternion::from_euler_angles(0.5, 0.2, -1.0);
    let mut estimates: Vec<_> = (0..4)
        .map(|_| Estimate {
            state: mean.plus(&(white::<3>(&mut random) * 0.3)),
            covariance: covariance::<3>(&mut random),
        })
        .collect();
    for weights in BOTH {
        let fused = covariance_intersection(&estimates, weights).expect("definite");
        estimates.reverse();
        let reversed = covariance_intersection(&estimates, weights).expect("definite");
        let apart = fused.state.minus(&reversed.state).norm();
        assert!(apart < 1e-6, "{weights:?} {apart}");
        let pulled = fused.state.minus(&estimates[0].state).norm();
        assert!(pulled > 1e-3, "the first estimate alone is another answer");
    }
}
