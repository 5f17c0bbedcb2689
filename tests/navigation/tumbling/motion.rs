//! The motion of a free body and its derivatives.

use super::simulated::at_start;
use crate::reference_body::{self, PRINCIPAL_MOMENTS, RATIOS, STATES, rate_rad_s};
use nalgebra::{SVector, UnitQuaternion, Vector3};
use opnav::geometry::central_difference;
use opnav::navigation::tumbling::*;

#[test]
fn acceleration_and_its_derivatives_are_those_of_the_equations_and_agree_with_differences() {
    let body = FreeBody::new(&RATIOS).unwrap();
    let rate = rate_rad_s();
    let (m, n) = (reference_body::acceleration_by_rate(), reference_body::acceleration_by_ratios());
    assert!((body.acceleration_rad_s2(&rate) - reference_body::acceleration_rad_s2()).norm() < 1e-11);
    assert!((body.acceleration_by_rate(&rate) - m).amax() < 1e-11);
    assert!((body.acceleration_by_inertia(&rate) - n).amax() < 1e-11);
    let by_rate = central_difference::<Vector3<f64>, Vector3<f64>, 3, 3>(|w| body.acceleration_rad_s2(w), &rate, 1e-5);
    assert!((by_rate - m).amax() < 1e-9);
    let by_ratios = central_difference::<SVector<f64, 5>, Vector3<f64>, 5, 3>(
        |l| FreeBody::new(&InertiaRatios((*l).into())).unwrap().acceleration_rad_s2(&rate),
        &RATIOS.vector(),
        1e-5,
    );
    assert!((by_ratios - n).amax() < 1e-9);
}

#[test]
fn principal_moments_are_eigenvalues_and_keep_the_triangle_inequality() {
    assert!(RATIOS.principal_moments().iter().zip(PRINCIPAL_MOMENTS).all(|(a, b)| (a - b).abs() < 1e-9));
    assert!(RATIOS.is_physical() && !InertiaRatios([0.2, 0.2, 0.0, 0.0, 0.0]).is_physical());
}

#[test]
fn motion_reaches_the_known_states() {
    let times_s: Vec<f64> = (0..=600).map(f64::from).collect();
    let points = propagate(&at_start(rate_rad_s()), &RATIOS, &times_s).unwrap();
    for known in STATES {
        let found = points[known.t_s as usize].state;
        let turn_rad = found.asteroid_from_inertial.angle_to(&known.asteroid_from_inertial());
        assert!(turn_rad < 2e-8, "t = {}: {turn_rad}", known.t_s);
        let off_rad_s = (found.rate_in_asteroid_rad_s - known.rate_in_asteroid_rad_s()).norm();
        assert!(off_rad_s < 1e-9, "t = {}: {off_rad_s}", known.t_s);
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
    x.fixed_rows_mut::<3>(0).copy_from(&rate_rad_s());
    x.fixed_rows_mut::<5>(3).copy_from(&RATIOS.vector());
    let numeric = central_difference::<_, SpinState, 8, 6>(|x| flown(x).state, &x, 1e-6);
    let analytic = flown(&x).sensitivity;
    assert!((numeric - analytic).amax() < 1e-5 * analytic.amax(), "{numeric}{analytic}");
}
