//! Every analytic Jacobian of both filters against central differences, and what yaw must never do.

use super::descent::{PLANET, exact_increment, truth};
use nalgebra::{DVector, Isometry3, Matrix2, SMatrix, SVector, Unit, UnitQuaternion, Vector2, Vector3};
use opnav::dataset::{ImuNoise, ImuSample};
use opnav::geometry::so3::{exp, log, tangent_basis};
use opnav::geometry::{Camera, Distortion, Manifold, central_difference};
use opnav::navigation::filter::Gate;
use opnav::navigation::landing::{
    BearingObservation, CameraMount, Core, CorrectionModel, DescentEstimate, DescentState, FilterKind, ImuBiases,
    ImuIncrement, ImuRecord, UnknownLandmark, innovation, predict,
};
use opnav::observations::TrackObservation;

pub const KINDS: [FilterKind; 2] = [FilterKind::Hybrid, FilterKind::Standard];
const CAMERA_IN_LANDER_M: Vector3<f64> = Vector3::new(1.0, -2.0, 0.5);

pub fn state() -> DescentState {
    let now = truth(60.0);
    DescentState {
        lander_in_site_m: now.position_m,
        lander_velocity_in_site_m_s: now.velocity_m_s,
        lander_from_site: UnitQuaternion::from_euler_angles(0.2, -0.1, 0.7),
        biases: None,
        landmarks: vec![UnknownLandmark::new(4, Vector3::new(1400.0, 3300.0, 12.0), 0)],
    }
}

pub fn increment() -> ImuIncrement {
    let mut increment = exact_increment(&truth(60.0), &truth(64.0), 4.0);
    increment.before_from_after *= exp(&Vector3::new(0.05, 0.02, -0.1));
    increment
}

/// A state with its error coordinates written out a second time, as the design defines them.
#[derive(Clone)]
pub struct Chart(pub FilterKind, pub DescentState);

impl Manifold<12> for Chart {
    fn plus(&self, d: &SVector<f64, 12>) -> Self {
        Chart(self.0, self.0.retract(self.1.clone(), d.as_slice()))
    }
    fn minus(&self, other: &Self) -> SVector<f64, 12> {
        let (a, b) = (&self.1, &other.1);
        let hybrid = self.0 == FilterKind::Hybrid;
        let vector = |x: &Vector3<f64>, y: &Vector3<f64>| {
            if hybrid { a.lander_from_site * x - b.lander_from_site * y } else { x - y }
        };
        let attitude = if hybrid {
            -log(&(b.lander_from_site.inverse() * a.lander_from_site))
        } else {
            -log(&(a.lander_from_site * b.lander_from_site.inverse()))
        };
        let mut d = SVector::<f64, 12>::zeros();
        d.fixed_rows_mut::<3>(0).copy_from(&vector(&a.lander_in_site_m, &b.lander_in_site_m));
        d.fixed_rows_mut::<3>(3).copy_from(&vector(&a.lander_velocity_in_site_m_s, &b.lander_velocity_in_site_m_s));
        d.fixed_rows_mut::<3>(6).copy_from(&attitude);
        let (p, q) = (&a.landmarks[0].position_in_site_m, &b.landmarks[0].position_in_site_m);
        d.fixed_rows_mut::<3>(9).copy_from(&vector(p, q));
        d
    }
}

pub fn moved(state: &DescentState, increment: &ImuIncrement) -> DescentState {
    let estimate = DescentEstimate { state: state.clone(), covariance: nalgebra::DMatrix::zeros(12, 12) };
    predict(estimate, increment, &PLANET, FilterKind::Hybrid).state
}

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

pub fn model(kind: FilterKind) -> CorrectionModel {
    CorrectionModel {
        kind,
        gate: Gate { confidence: 0.999 },
        iterations: 1,
        camera_in_lander_m: CAMERA_IN_LANDER_M,
        second_order: true,
    }
}

pub fn bearing_to(state: &DescentState, track_id: u64, point_m: &Vector3<f64>) -> BearingObservation {
    let relative = state.lander_from_site * (point_m - state.lander_in_site_m) - CAMERA_IN_LANDER_M;
    BearingObservation::from_sigma(track_id, Unit::new_normalize(relative), 1e-3)
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

#[test]
fn measurement_jacobian_is_the_derivative_of_the_bearing() {
    let state = state();
    let landmark_m = state.landmarks[0].position_in_site_m;
    for (kind, track, point_m) in KINDS.iter().flat_map(|k| [(*k, 0, Vector3::zeros()), (*k, 4, landmark_m)]) {
        let bearing = bearing_to(&state, track, &point_m);
        let at = |s: &DescentState| innovation(s, &bearing, &Matrix2::identity(), &model(kind)).expect("ahead");
        let here = at(&state);
        assert!(here.residual.norm() < 1e-12, "{kind:?} residual at the truth");
        let residual = |c: &Chart| Vector2::from_column_slice((-at(&c.1).residual).as_slice());
        let numeric: SMatrix<f64, 2, 12> = central_difference(residual, &Chart(kind, state.clone()), 1e-4);
        let analytic = SMatrix::<f64, 2, 12>::from_column_slice(here.dense(12).jacobian.as_slice());
        assert!((numeric - analytic).amax() < 1e-8, "{kind:?} track {track}: {}", numeric - analytic);
    }
}

/// A turn about the vertical through the site, in each filter's coordinates, changes no bearing; in the hybrid ones the
/// motion keeps it exactly: its column of F is that of the identity, bit for bit.
#[test]
fn yaw_is_never_observed() {
    let state = state();
    let landmark_m = state.landmarks[0].position_in_site_m;
    let up = Vector3::z();
    for kind in KINDS {
        let mut yaw = DVector::zeros(12);
        if kind == FilterKind::Hybrid {
            yaw[8] = 1.0;
        } else {
            yaw.rows_mut(0, 3).copy_from(&-state.lander_in_site_m.cross(&up));
            yaw.rows_mut(3, 3).copy_from(&-state.lander_velocity_in_site_m_s.cross(&up));
            yaw.rows_mut(6, 3).copy_from(&(state.lander_from_site * up));
            yaw.rows_mut(9, 3).copy_from(&-landmark_m.cross(&up));
        }
        for (track, point_m) in [(0, Vector3::zeros()), (4, landmark_m)] {
            let bearing = bearing_to(&state, track, &point_m);
            let model = CorrectionModel { camera_in_lander_m: Vector3::zeros(), ..model(kind) };
            let h = innovation(&state, &bearing, &Matrix2::identity(), &model).expect("ahead").dense(12).jacobian;
            assert!((h * &yaw).norm() <= 1e-12, "{kind:?} track {track}");
        }
    }
    let increment = increment();
    let f = FilterKind::Hybrid
        .transition(&Core::of(&state), &moved(&state, &increment), &increment, &PLANET)
        .state_matrix();
    let expected = DVector::from_fn(12, |k, _| if k == 8 { 1.0 } else { 0.0 });
    assert_eq!(f.column(8).into_owned(), expected);
}

#[test]
fn landmark_on_ground_has_the_right_derivatives() {
    let state = state();
    let bearing = bearing_to(&state, 9, &Vector3::new(300.0, 900.0, 0.0));
    for kind in KINDS {
        let at = |s: &DescentState, b: &BearingObservation, height_m: f64| {
            let spot =
                kind.point_on_ground(s, &b.direction_in_lander, &CAMERA_IN_LANDER_M, height_m).expect("it looks down");
            let p = spot.position_in_site_m;
            if kind == FilterKind::Hybrid { s.lander_from_site * p } else { p }
        };
        let spot = kind
            .point_on_ground(&state, &bearing.direction_in_lander, &CAMERA_IN_LANDER_M, 0.0)
            .expect("it looks down");
        assert!((spot.position_in_site_m - Vector3::new(300.0, 900.0, 0.0)).norm() < 1e-9);
        let numeric: SMatrix<f64, 3, 12> =
            central_difference(|c: &Chart| at(&c.1, &bearing, 0.0), &Chart(kind, state.clone()), 1e-4);
        let mut analytic = SMatrix::<f64, 3, 12>::zeros();
        analytic.fixed_view_mut::<3, 3>(0, 0).copy_from(&spot.by_position);
        analytic.fixed_view_mut::<3, 3>(0, 6).copy_from(&spot.by_attitude);
        assert!((numeric - analytic).amax() < 1e-4, "{kind:?} by state {}", numeric - analytic);
        let by_height = (at(&state, &bearing, 0.5) - at(&state, &bearing, -0.5)) - spot.by_height;
        assert!(by_height.norm() < 1e-8, "{kind:?} by height");
        let across = tangent_basis(&bearing.direction_in_lander);
        let turned = |d: &Vector2<f64>| {
            let direction = Unit::new_normalize(bearing.direction_in_lander.into_inner() + across * d);
            at(&state, &BearingObservation { direction_in_lander: direction, ..bearing }, 0.0)
        };
        let numeric: SMatrix<f64, 3, 2> = central_difference(turned, &Vector2::zeros(), 1e-6);
        assert!((numeric - spot.by_bearing * across).amax() < 1e-4, "{kind:?} by bearing");
    }
    let upward = BearingObservation::from_sigma(9, state.lander_from_site * Vector3::z_axis(), 1e-3);
    assert_eq!(FilterKind::Hybrid.point_on_ground(&state, &upward.direction_in_lander, &CAMERA_IN_LANDER_M, 0.0), None);
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

#[test]
fn pixel_noise_goes_through_the_camera() {
    let camera = Camera {
        distortion: Distortion::RadialTangential([-0.1, 0.01, 1e-3, -5e-4]),
        ..Camera::from_fov(512, 512, 1.5)
    };
    let lander_from_camera = Isometry3::new(Vector3::new(0.1, 0.2, 0.3), Vector3::new(2.9, 0.3, -0.2));
    let mount = CameraMount { camera, lander_from_camera };
    let at = |pixel_px: Vector2<f64>| TrackObservation { t_ns: 0, track_id: 3, pixel_px, sigma_px: 0.3, response: 0.0 };
    let pixel = Vector2::new(480.0, 60.0);
    let here = mount.bearing(&at(pixel), 0.1).expect("invertible");
    let across = tangent_basis(&here.direction_in_lander).transpose();
    let shifted =
        |p: &Vector2<f64>| across * mount.bearing(&at(*p), 0.1).expect("invertible").direction_in_lander.into_inner();
    let j: SMatrix<f64, 2, 2> = central_difference(shifted, &pixel, 1e-3);
    let expected = j * j.transpose() * 0.09;
    assert!((here.covariance_rad2 - expected).norm() < 1e-6 * expected.norm());
    assert_eq!(mount.bearing(&at(pixel), 0.6).expect("invertible").covariance_rad2, here.covariance_rad2 * 4.0);
}

pub fn imu_samples() -> Vec<ImuSample> {
    (1..=200)
        .map(|k| ImuSample {
            t_ns: k * 10_000_000,
            rate_in_lander_rad_s: Vector3::new(0.1, -0.2, 0.05) * (k as f64 * 0.05).sin(),
            specific_force_in_lander_m_s2: Vector3::new(0.3, 0.1, 4.0 + 0.01 * k as f64),
        })
        .collect()
}

pub const NOISE: ImuNoise =
    ImuNoise { rate_hz: 100.0, gyroscope_noise_density: 1e-3, accelerometer_noise_density: 2e-2, bias: None };

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
