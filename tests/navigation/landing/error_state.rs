//! Error coordinates and the transition of both filters against central differences.

use super::chart::{Chart, KINDS, NOISE, imu_samples, increment, moved, state};
use super::descent::PLANET;
use nalgebra::{DVector, SMatrix, SVector, UnitQuaternion, Vector3};
use opnav::dataset::{ImuNoise, ImuSample};
use opnav::geometry::so3::{exp, log};
use opnav::geometry::{Manifold, central_difference};
use opnav::navigation::landing::{Core, DescentEstimate, FilterKind, ImuBiases, ImuIncrement, ImuRecord, predict};

/// The paper's q = [q_v; q_w] and its C(q) = I - 2 q_w [q_v×] + 2 [q_v×]² are our `lander_from_site`, q_v with its sign
/// changed; equation (1) moves it as the IMU does once the lower left of Ω is -ωᵀ.
#[test]
fn attitude_agrees_with_the_papers_quaternion() {
    let paper = |q: &UnitQuaternion<f64>| (-q.imag(), q.w);
    let matrix = |(v, w): (Vector3<f64>, f64)| {
        let k = v.cross_matrix();
        nalgebra::Matrix3::identity() - k * (2.0 * w) + k * k * 2.0
    };
    let before = state();
    let c = before.lander_from_site;
    assert!((matrix(paper(&c)) - c.to_rotation_matrix().into_inner()).norm() < 1e-14);
    let (rate, dt_s) = (Vector3::new(0.3, -0.2, 0.5), 1e-4);
    let sample = ImuSample { t_ns: 0, rate_in_lander_rad_s: rate, specific_force_in_lander_m_s2: Vector3::zeros() };
    let after = moved(&before, &ImuIncrement::identity().extended(&sample, dt_s, &NOISE, &ImuBiases::default()));
    let (v, w) = paper(&c);
    let dv = (-rate.cross(&v) + rate * w) * (0.5 * dt_s);
    let dw = -rate.dot(&v) * (0.5 * dt_s);
    let expected = after.lander_from_site.to_rotation_matrix().into_inner();
    assert!((matrix((v + dv, w + dw)) - expected).norm() < 1e-8);
}

#[test]
fn retraction_and_error_are_inverse() {
    let d = SVector::<f64, 12>::from_fn(|k, _| 0.03 * (k as f64 - 5.5));
    for kind in KINDS {
        let chart = Chart(kind, state());
        assert!((chart.plus(&d).minus(&chart) - d).norm() < 1e-9, "{kind:?}");
    }
}

#[test]
fn transition_is_the_derivative_of_the_motion() {
    for kind in KINDS {
        let (before, increment) = (Chart(kind, state()), increment());
        let after = moved(&before.1, &increment);
        let transition = kind.transition(&Core::of(&before.1), &after, &increment, &PLANET);
        let motion = |c: &Chart| Chart(kind, moved(&c.1, &increment));
        let numeric: SMatrix<f64, 12, 12> = central_difference(motion, &before, 1e-4);
        let analytic = SMatrix::<f64, 12, 12>::from_column_slice(transition.state_matrix().as_slice());
        assert!((numeric - analytic).amax() < 2e-5, "{kind:?} F {}", numeric - analytic);
        let noisy = |n: &SVector<f64, 9>| {
            let part = |k: usize| n.fixed_rows::<3>(k).into_owned();
            let other = ImuIncrement {
                before_from_after: increment.before_from_after * exp(&part(0)),
                velocity_in_before_m_s: increment.velocity_in_before_m_s + part(3),
                position_in_before_m: increment.position_in_before_m + part(6),
                ..increment.clone()
            };
            Chart(kind, moved(&before.1, &other))
        };
        let numeric: SMatrix<f64, 12, 9> = central_difference(noisy, &SVector::<f64, 9>::zeros(), 1e-4);
        let analytic = SMatrix::<f64, 12, 9>::from_column_slice(transition.noise_matrix().as_slice());
        assert!((numeric - analytic).amax() < 1e-4, "{kind:?} G {}", numeric - analytic);
    }
}

/// Without images the covariance never shrinks: its volume grows by the IMU's noise alone.
#[test]
fn prediction_never_shrinks_the_covariance() {
    let mut noisy = increment();
    noisy.covariance = SMatrix::identity() * 1e-8;
    for kind in KINDS {
        let covariance = nalgebra::DMatrix::from_diagonal(&DVector::from_fn(12, |k, _| 0.1 + 0.01 * k as f64));
        let before = DescentEstimate { state: state(), covariance };
        for (increment, grows) in [(increment(), false), (noisy.clone(), true)] {
            let after = predict(before.clone(), &increment, &PLANET, kind);
            let ratio = after.covariance.determinant() / before.covariance.determinant();
            assert!(ratio > 1.0 - 1e-9 && (ratio > 1.0 + 1e-6) == grows, "{kind:?}: {ratio}");
        }
    }
}

/// Second-order site covariance against samples: errors of 1.7° about the vertical at 4 km make a clear arc.
#[test]
fn site_covariance_has_the_second_order() {
    let mut state = state();
    state.landmarks.clear();
    let sigma = SVector::<f64, 9>::from_column_slice(&[3.0, 2.0, 4.0, 0.2, 0.1, 0.3, 0.02, 0.02, 0.03]);
    let covariance = nalgebra::DMatrix::from_diagonal(&DVector::from_column_slice(sigma.map(|s| s * s).as_slice()));
    let estimate = DescentEstimate { state: state.clone(), covariance };
    let analytic = FilterKind::Hybrid.site_covariance(&estimate);
    let mut random = opnav::stats::random_stream(1, "site covariance", 0);
    let mut sampled = SMatrix::<f64, 9, 9>::zeros();
    let samples = 100_000;
    for _ in 0..samples {
        let unit = SVector::<f64, 9>::from_fn(|_, _| super::descent::normal3(&mut random, 1.0).x);
        let error = DVector::from_column_slice(unit.component_mul(&sigma).as_slice());
        let moved = FilterKind::Hybrid.retract(state.clone(), error.as_slice());
        let mut e = SVector::<f64, 9>::zeros();
        e.fixed_rows_mut::<3>(0).copy_from(&(moved.lander_in_site_m - state.lander_in_site_m));
        e.fixed_rows_mut::<3>(3).copy_from(&(moved.lander_velocity_in_site_m_s - state.lander_velocity_in_site_m_s));
        e.fixed_rows_mut::<3>(6).copy_from(&log(&(moved.lander_from_site.inverse() * state.lander_from_site)));
        sampled += e * e.transpose() / f64::from(samples);
    }
    // Generalised eigenvalues: the ratio of the two variances in every direction at once.
    let l = analytic.cholesky().expect("positive definite").l().try_inverse().expect("regular");
    let ratios = (l * sampled * l.transpose()).symmetric_eigenvalues();
    assert!(ratios.iter().all(|r| (0.85..1.15).contains(r)), "{ratios}");
}

/// Two increments in a row move a state, mean and covariance, as the one over both intervals does; the cut lies inside a
/// sample.
#[test]
fn increments_compose() {
    let samples = imu_samples();
    let imu = ImuRecord { samples: &samples, noise: &NOISE };
    let mut state = state();
    state.landmarks.clear();
    let start = DescentEstimate { state, covariance: nalgebra::DMatrix::zeros(9, 9) };
    let between = |from_ns, to_ns| imu.between(from_ns, to_ns, &ImuBiases::default()).expect("covered");
    let go = |e: &DescentEstimate, from_ns, to_ns| {
        predict(e.clone(), &between(from_ns, to_ns), &PLANET, FilterKind::Standard)
    };
    let once = go(&start, 0, 2_000_000_000);
    let twice = go(&go(&start, 0, 703_000_000), 703_000_000, 2_000_000_000);
    assert!((once.state.lander_in_site_m - twice.state.lander_in_site_m).norm() < 1e-6);
    assert!((once.state.lander_velocity_in_site_m_s - twice.state.lander_velocity_in_site_m_s).norm() < 1e-8);
    assert!(once.state.lander_from_site.angle_to(&twice.state.lander_from_site) < 1e-10);
    assert!((&once.covariance - &twice.covariance).norm() < 1e-3 * once.covariance.norm());
    let variance_m2_s2 = NOISE.accelerometer_noise_density.powi(2) * 2.0;
    let quiet = ImuNoise { gyroscope_noise_density: 1e-12, ..NOISE };
    let record = ImuRecord { samples: &samples, noise: &quiet };
    let alone = record.between(0, 2_000_000_000, &ImuBiases::default()).expect("covered").covariance;
    assert!((alone[(4, 4)] / variance_m2_s2 - 1.0).abs() < 1e-9);
    assert!((alone[(7, 7)] / (variance_m2_s2 * 4.0 / 3.0) - 1.0).abs() < 1e-3);
}
