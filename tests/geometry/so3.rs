//! Rotations: exponential, logarithm and Jacobians over the whole group.

use nalgebra::{Matrix3, SVector, Unit, UnitQuaternion, Vector3};
use opnav::geometry::so3::{
    exp, hat, left_jacobian, left_jacobian_inverse, log, right_jacobian, right_jacobian_inverse, tangent_basis,
};
use opnav::geometry::{Manifold, central_difference};
use proptest::prelude::*;
use std::f64::consts::PI;

fn config() -> ProptestConfig {
    ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() }
}

fn direction() -> impl Strategy<Value = Vector3<f64>> {
    (-1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64)
        .prop_map(|(x, y, z)| Vector3::new(x, y, z))
        .prop_filter("a direction needs length", |v| v.norm() > 0.1)
        .prop_map(|v| v.normalize())
}

/// Rotation vectors of every size that matters: nothing, tiny, at the series' switch, ordinary, just under half a turn.
fn rotation_vector() -> impl Strategy<Value = Vector3<f64>> {
    let size = prop_oneof![
        Just(0.0),
        1e-15..1e-9f64,
        0.5e-4..2e-4f64,
        0.5e-3..2e-3f64,
        0.01..3.0f64,
        (1e-12..1e-3f64).prop_map(|gap| PI - gap),
    ];
    (direction(), size).prop_map(|(n, angle)| n * angle)
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn log_undoes_exp_everywhere(phi in rotation_vector()) {
        prop_assert!((log(&exp(&phi)) - phi).norm() <= 1e-14 * (1.0 + phi.norm()));
    }

    #[test]
    fn exp_agrees_with_the_matrix_series(phi in rotation_vector()) {
        let k = hat(&phi);
        let mut term = Matrix3::identity();
        let mut series = Matrix3::identity();
        for n in 1..40 {
            term = term * k / f64::from(n);
            series += term;
        }
        prop_assert!((exp(&phi).to_rotation_matrix().matrix() - series).abs().max() < 1e-13);
    }

    #[test]
    fn rotations_keep_the_laws_of_plus_and_minus(a in rotation_vector(), b in rotation_vector(), d in rotation_vector()) {
        let (x, y) = (exp(&a), exp(&b));
        prop_assert!(x.plus(&y.minus(&x)).angle_to(&y) < 1e-13);
        prop_assert!((x.plus(&d).minus(&x) - d).norm() < 1e-13);
        prop_assert!(x.minus(&x).norm() < 1e-15);
    }

    #[test]
    fn jacobians_agree_with_central_differences(phi in rotation_vector()) {
        let of = |v: &SVector<f64, 3>| exp(v);
        let right: Matrix3<f64> = central_difference(of, &phi, 1e-5);
        prop_assert!((right - right_jacobian(&phi)).abs().max() < 1e-9);
        // The left one moves in the other frame: J_l = R J_r.
        let left = exp(&phi).to_rotation_matrix().matrix() * right;
        prop_assert!((left - left_jacobian(&phi)).abs().max() < 1e-9);
    }

    #[test]
    fn inverse_jacobians_are_inverses(phi in rotation_vector()) {
        let left = left_jacobian(&phi) * left_jacobian_inverse(&phi);
        let right = right_jacobian(&phi) * right_jacobian_inverse(&phi);
        prop_assert!((left - Matrix3::identity()).abs().max() < 1e-12, "{left}");
        prop_assert!((right - Matrix3::identity()).abs().max() < 1e-12, "{right}");
    }

    #[test]
    fn tangent_bases_are_orthonormal_and_right_handed(n in direction()) {
        let n = Unit::new_normalize(n);
        let basis = tangent_basis(&n);
        prop_assert!((basis.transpose() * basis - nalgebra::Matrix2::identity()).abs().max() < 1e-14);
        prop_assert!((basis.transpose() * n.as_ref()).norm() < 1e-14);
        let out: Vector3<f64> = basis.column(0).cross(&basis.column(1));
        prop_assert!((out - n.as_ref()).norm() < 1e-14);
    }
}

#[test]
fn log_takes_the_short_way_for_either_sign_of_the_quaternion() {
    let q = exp(&Vector3::new(0.3, -0.2, 0.1));
    let negative = UnitQuaternion::new_unchecked(-q.into_inner());
    assert!((log(&q) - log(&negative)).norm() < 1e-15);
    assert!((log(&exp(&Vector3::new(0.0, 0.0, 1.5 * PI))) - Vector3::new(0.0, 0.0, -0.5 * PI)).norm() < 1e-14);
    assert!((log(&exp(&Vector3::new(PI, 0.0, 0.0))).norm() - PI).abs() < 1e-14);
}

#[test]
fn plus_acts_on_the_right() {
    let q = exp(&Vector3::new(0.0, 0.0, 0.5 * PI));
    let d = Vector3::new(0.1, 0.0, 0.0);
    assert!(q.plus(&d).angle_to(&(q * exp(&d))) < 1e-15);
    assert!(q.plus(&d).angle_to(&(exp(&d) * q)) > 0.1, "the order of a turn and a move must matter here");
}

#[test]
fn a_wrong_jacobian_is_noticed() {
    let phi = Vector3::new(0.4, -0.7, 0.2);
    let right: Matrix3<f64> = central_difference(|v: &SVector<f64, 3>| exp(v), &phi, 1e-5);
    assert!((right - left_jacobian(&phi)).abs().max() > 0.1);
}

#[test]
fn hat_is_the_cross_product() {
    let (a, b) = (Vector3::new(1.0, -2.0, 3.0), Vector3::new(0.5, 0.25, -4.0));
    assert_eq!(hat(&a) * b, a.cross(&b));
}
