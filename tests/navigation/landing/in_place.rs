//! The covariance moved and corrected in place: without allocation, and equal to what dense matrices give; known points,
//! biases and the planet's rotation against central differences.

use super::chart::{Chart, KINDS, NOISE, bearing_to, dense, imu_samples, increment, model, moved, state};
use super::descent::PLANET;
use nalgebra::{DVector, Matrix2, SMatrix, SVector, Unit, Vector3};
use opnav::geometry::central_difference;
use opnav::geometry::so3::{log, tangent_basis};
use opnav::navigation::filter::Gate;
use opnav::navigation::landing::{
    BearingObservation, Core, CorrectionModel, DescentEstimate, DescentState, ImuBiases, ImuIncrement, ImuRecord,
    KnownPoint, Planet, UnknownLandmark, correct, innovation, predict,
};

/// A step of the filter at one known and one unknown landmark, allocated once, allocates nothing.
#[test]
fn a_filter_step_does_not_allocate() {
    let covariance = nalgebra::DMatrix::from_diagonal(&DVector::from_fn(12, |k, _| 0.1 + 0.01 * k as f64));
    let estimate = DescentEstimate { state: state(), covariance };
    let increment = increment();
    let after = moved(&estimate.state, &increment);
    let bearings =
        [bearing_to(&after, 0, &Vector3::zeros()), bearing_to(&after, 4, &after.landmarks[0].position_in_site_m)];
    for kind in KINDS {
        let (estimate, model) = (estimate.clone(), model(kind));
        let mut outcome = None;
        let counted = allocation_counter::measure(|| {
            outcome = correct(predict(estimate, &increment, &PLANET, kind), &bearings, &model);
        });
        assert_eq!(counted.count_total, 0, "{kind:?}");
        let outcome = outcome.expect("positive definite");
        assert!(outcome.outcomes.iter().all(|o| o.used) && outcome.outcomes.len() == 2);
    }
    // The counter counts: a longer list of landmarks is allocated anew.
    assert!(allocation_counter::measure(|| drop(std::hint::black_box(state()))).count_total > 0);
}

/// Bearings one after the other in blocks are the same as all at once with dense matrices.
#[test]
fn bearings_in_turn_are_bearings_at_once() {
    let mut state = state();
    state.landmarks.push(UnknownLandmark::new(7, Vector3::new(900.0, 2000.0, -5.0), 1));
    state.biases = Some(ImuBiases::default());
    const SIZE: usize = 21;
    let n = state.error_size();
    assert_eq!(n, SIZE);
    let root = nalgebra::DMatrix::from_fn(n, n, |i, j| ((7 * i + 3 * j) % 11) as f64 * 0.02 + f64::from(i == j));
    let covariance = &root * root.transpose();
    let known = KnownPoint { position_in_site_m: Vector3::new(300.0, -200.0, 40.0), sigma_m: 2.0 };
    for kind in KINDS {
        let estimate = DescentEstimate { state: state.clone(), covariance: covariance.clone() };
        let off = |b: BearingObservation, by: f64| {
            let moved = b.direction_in_lander.into_inner() + tangent_basis(&b.direction_in_lander).column(0) * by;
            BearingObservation { direction_in_lander: Unit::new_normalize(moved), ..b }
        };
        let to_known = bearing_to(&state, 99, &known.position_in_site_m);
        let bearings = [
            off(bearing_to(&state, 0, &Vector3::zeros()), 2e-4),
            off(bearing_to(&state, 4, &state.landmarks[0].position_in_site_m), -3e-4),
            off(bearing_to(&state, 7, &state.landmarks[1].position_in_site_m), 4e-4),
            BearingObservation { known: Some(known), ..off(to_known, 1e-4) },
        ];
        let model = CorrectionModel { gate: Gate { confidence: 1.0 - 1e-12 }, second_order: false, ..model(kind) };
        let in_turn = correct(estimate.clone(), &bearings, &model).expect("positive definite");
        let mut residual = SVector::<f64, 8>::zeros();
        let mut jacobian = SMatrix::<f64, 8, SIZE>::zeros();
        let mut noise = SMatrix::<f64, 8, 8>::zeros();
        for (k, bearing) in bearings.iter().enumerate() {
            let part = innovation(&state, bearing, &bearing.covariance_rad2, &model).expect("ahead");
            residual.fixed_rows_mut::<2>(2 * k).copy_from(&part.residual);
            jacobian.fixed_rows_mut::<2>(2 * k).copy_from(&dense(&part));
            noise.fixed_view_mut::<2, 2>(2 * k, 2 * k).copy_from(&part.noise);
        }
        // Kalman's form for all rows together, written out.
        let weight = (jacobian * &covariance * jacobian.transpose() + noise).try_inverse().expect("definite");
        let gain = &covariance * jacobian.transpose() * weight;
        let shift = &gain * residual;
        let expected_covariance = &covariance - &gain * jacobian * &covariance;
        let expected = kind.retract(state.clone(), shift.as_slice());
        let found = &in_turn.estimate;
        assert!(in_turn.outcomes.iter().all(|o| o.used), "{:?}", in_turn.outcomes);
        assert!((found.state.lander_in_site_m - expected.lander_in_site_m).norm() < 1e-9, "{kind:?}");
        let moved = (found.state.landmarks[1].position_in_site_m - expected.landmarks[1].position_in_site_m).norm();
        assert!(
            moved < 1e-9
                && (expected.landmarks[1].position_in_site_m - state.landmarks[1].position_in_site_m).norm() > 1e-6
        );
        assert!((&found.covariance - &expected_covariance).amax() < 1e-9 * covariance.amax(), "{kind:?}");
        let nis = in_turn.normalized_innovation_squared.expect("used");
        assert!((nis / residual.dot(&(weight * residual)) - 1.0).abs() < 1e-9, "{kind:?}");
    }
}

/// The Jacobian of the bearing of a known point that is not the origin, and of the motion with biases on a planet that
/// turns, against central differences.
#[test]
fn known_points_biases_and_rotation_have_the_right_derivatives() {
    let state = state();
    let known = KnownPoint { position_in_site_m: Vector3::new(300.0, -200.0, 40.0), sigma_m: 0.0 };
    let planet = Planet { rate_in_site_rad_s: Vector3::new(0.02, -0.03, 0.05), ..PLANET };
    for kind in KINDS {
        let bearing = BearingObservation { known: Some(known), ..bearing_to(&state, 9, &known.position_in_site_m) };
        let at = |s: &DescentState| innovation(s, &bearing, &Matrix2::identity(), &model(kind)).expect("ahead");
        let residual = |c: &Chart| -at(&c.1).residual;
        let numeric: SMatrix<f64, 2, 12> = central_difference(residual, &Chart(kind, state.clone()), 1e-4);
        let analytic: SMatrix<f64, 2, 12> = dense(&at(&state));
        assert!((numeric - analytic).amax() < 1e-8, "{kind:?} known point {}", numeric - analytic);

        let increment = increment();
        let go = |s: &DescentState, i: &ImuIncrement| {
            let size = s.error_size();
            let start = DescentEstimate { state: s.clone(), covariance: nalgebra::DMatrix::zeros(size, size) };
            predict(start, i, &planet, kind).state
        };
        let transition = kind.transition(&Core::of(&state), &go(&state, &increment), &increment, &planet);
        let motion = |c: &Chart| Chart(kind, go(&c.1, &increment));
        let numeric: SMatrix<f64, 12, 12> = central_difference(motion, &Chart(kind, state.clone()), 1e-4);
        let analytic = SMatrix::<f64, 12, 12>::from_column_slice(transition.state_matrix().as_slice());
        assert!((numeric - analytic).amax() < 5e-5, "{kind:?} rotation F {}", numeric - analytic);
        let noisy = |n: &SVector<f64, 9>| Chart(kind, go(&state, &increment.adjusted(n)));
        let numeric: SMatrix<f64, 12, 9> = central_difference(noisy, &SVector::<f64, 9>::zeros(), 1e-4);
        let analytic = SMatrix::<f64, 12, 9>::from_column_slice(transition.noise_matrix().as_slice());
        assert!((numeric - analytic).amax() < 1e-4, "{kind:?} rotation G {}", numeric - analytic);
    }
}

/// What a bias does to an increment: the derivative by it, against increments with the bias taken off.
#[test]
fn increments_know_what_biases_do() {
    let samples = imu_samples();
    let imu = ImuRecord { samples: &samples, noise: &NOISE };
    let between = |b: &SVector<f64, 6>| {
        let biases = ImuBiases {
            gyroscope_rad_s: b.fixed_rows::<3>(0).into_owned(),
            accelerometer_m_s2: b.fixed_rows::<3>(3).into_owned(),
        };
        imu.between(0, 1_500_000_000, &biases).expect("covered")
    };
    let here = between(&SVector::zeros());
    let error = |b: &SVector<f64, 6>| {
        let there = between(b);
        let mut e = SVector::<f64, 9>::zeros();
        e.fixed_rows_mut::<3>(0).copy_from(&log(&(here.before_from_after.inverse() * there.before_from_after)));
        e.fixed_rows_mut::<3>(3).copy_from(&(there.velocity_in_before_m_s - here.velocity_in_before_m_s));
        e.fixed_rows_mut::<3>(6).copy_from(&(there.position_in_before_m - here.position_in_before_m));
        e
    };
    let numeric: SMatrix<f64, 9, 6> = central_difference(error, &SVector::<f64, 6>::zeros(), 1e-5);
    assert!((numeric - here.by_bias).amax() < 2e-3 * here.by_bias.amax(), "{}", numeric - here.by_bias);
}
