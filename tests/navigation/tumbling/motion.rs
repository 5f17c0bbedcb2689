//! The motion of a free body and its derivatives.

use super::simulated::{PAPER, at_start, paper_rate, rate_deg_s};
use nalgebra::{Matrix3, Quaternion, SMatrix, SVector, UnitQuaternion, Vector3};
use opnav::geometry::central_difference;
use opnav::navigation::tumbling::*;

#[test]
fn jacobians_are_the_printed_ones_and_agree_with_differences() {
    let body = FreeBody::new(&PAPER).unwrap();
    let rate = paper_rate();
    let acceleration = Vector3::new(1.217511829e-3, 2.93714897e-4, -1.773544285e-3);
    assert!((body.acceleration_rad_s2(&rate) - acceleration).norm() < 1e-11);
    let m = Matrix3::new(
        0.005038761047,
        0.028564731271,
        0.013892540408,
        0.021810000755,
        -0.018034745273,
        -0.009689383329,
        -0.035301389804,
        -0.031396608872,
        0.012995984226,
    );
    let n = SMatrix::<f64, 3, 5>::from_row_slice(&[
        -0.001579831847,
        0.003879219443,
        0.008116078247,
        -0.00295674056,
        0.00318858645,
        -0.003468990953,
        -0.000924880967,
        -0.004077608013,
        0.003284006074,
        0.003081084495,
        0.003390082737,
        -0.004264304539,
        -0.007832279528,
        0.002098544964,
        -0.005827660146,
    ]);
    assert!((body.acceleration_by_rate(&rate) - m).amax() < 1e-11);
    assert!((body.acceleration_by_inertia(&rate) - n).amax() < 1e-11);
    let by_rate = central_difference::<Vector3<f64>, Vector3<f64>, 3, 3>(|w| body.acceleration_rad_s2(w), &rate, 1e-5);
    assert!((by_rate - m).amax() < 1e-9);
    let by_ratios = central_difference::<SVector<f64, 5>, Vector3<f64>, 5, 3>(
        |l| FreeBody::new(&InertiaRatios((*l).into())).unwrap().acceleration_rad_s2(&rate),
        &PAPER.vector(),
        1e-5,
    );
    assert!((by_ratios - n).amax() < 1e-9);
    let expected = [0.696715583, 1.109482306, 1.413802111];
    assert!(PAPER.principal_moments().iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9));
    assert!(PAPER.is_physical() && !InertiaRatios([0.2, 0.2, 0.0, 0.0, 0.0]).is_physical());
}

#[test]
fn motion_is_the_printed_one() {
    let times_s: Vec<f64> = (0..=600).map(f64::from).collect();
    let points = propagate(&at_start(paper_rate()), &PAPER, &times_s).unwrap();
    // Shuster's quaternions, scalar last: the vector part changes its sign.
    let expected = [
        (
            60,
            [0.649734687738, -0.32839425578, -0.348376965468, 0.590453671554],
            [0.519253989963, 2.152258543697, -6.26030457059],
        ),
        (
            600,
            [-0.025368477055, 0.097716333999, -0.180070744049, 0.978459240633],
            [1.629255771355, 3.64362201528, 5.21732795192],
        ),
    ];
    for (k, q, rate) in expected {
        let attitude = UnitQuaternion::from_quaternion(Quaternion::new(q[3], -q[0], -q[1], -q[2]));
        let found = points[k].state;
        assert!(found.asteroid_from_inertial.angle_to(&attitude) < 2e-8, "t = {k}");
        assert!((found.rate_in_asteroid_rad_s - rate_deg_s(rate[0], rate[1], rate[2])).norm() < 1e-9, "t = {k}");
    }
}

#[test]
fn sensitivities_agree_with_differences() {
    let start = UnitQuaternion::from_euler_angles(0.4, -0.9, 2.0);
    let flown = |x: &SVector<f64, 8>| {
        let state =
            SpinState { asteroid_from_inertial: start, rate_in_asteroid_rad_s: x.fixed_rows::<3>(0).into_owned() };
        let inertia = InertiaRatios(x.fixed_rows::<5>(3).into_owned().into());
        propagate(&state, &inertia, &[0.0, 20.0, 47.0]).unwrap().pop().unwrap()
    };
    let mut x = SVector::<f64, 8>::zeros();
    x.fixed_rows_mut::<3>(0).copy_from(&paper_rate());
    x.fixed_rows_mut::<5>(3).copy_from(&PAPER.vector());
    let numeric = central_difference::<_, SpinState, 8, 6>(|x| flown(x).state, &x, 1e-6);
    let analytic = flown(&x).sensitivity;
    assert!((numeric - analytic).amax() < 1e-5 * analytic.amax(), "{numeric}{analytic}");
}
