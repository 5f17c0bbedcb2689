//! A state with its error coordinates, and small parts that tests of derivatives share.

use super::descent::{PLANET, exact_increment, truth};
use nalgebra::{SMatrix, SVector, Unit, UnitQuaternion, Vector3};
use opnav::dataset::{ImuNoise, ImuSample};
use opnav::geometry::Manifold;
use opnav::geometry::so3::{exp, log};
use opnav::navigation::filter::Gate;
use opnav::navigation::landing::{
    BearingInnovation, BearingObservation, CorrectionModel, DescentEstimate, DescentState, FilterKind, ImuIncrement,
    UnknownLandmark, predict,
};

pub const KINDS: [FilterKind; 2] = [FilterKind::Hybrid, FilterKind::Standard];

pub const CAMERA_IN_LANDER_M: Vector3<f64> = Vector3::new(1.0, -2.0, 0.5);

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

/// The Jacobian of a bearing with the columns of 0 between its blocks.
pub fn dense<const N: usize>(innovation: &BearingInnovation) -> SMatrix<f64, 2, N> {
    let mut dense = SMatrix::<f64, 2, N>::zeros();
    for (start, block) in &innovation.jacobian {
        dense.fixed_view_mut::<2, 3>(0, *start).copy_from(block);
    }
    dense
}
