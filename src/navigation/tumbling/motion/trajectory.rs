//! Attitude and rate of a free body along time, with their derivatives by the initial conditions.

use super::dynamics::FreeBody;
use super::inertia::InertiaRatios;
use super::state::SpinState;
use nalgebra::{Quaternion, SMatrix, UnitQuaternion, Vector3};

/// Longest turn of one Runge–Kutta step, in radians: the error of the fourth-order rule is then 1e-10 a radian.
const STEP_RAD: f64 = 0.01;

/// More steps between two times mean a rate that no image could follow.
const MOST_STEPS: f64 = 20_000.0;

/// Derivative (6×8) of (attitude error in inertial axes, rate) by (initial rate, inertia ratios).
pub type Sensitivity = SMatrix<f64, 6, 8>;

/// A state with its derivative by the unknowns.
#[derive(Debug, Clone, PartialEq)]
pub struct TrajectoryPoint {
    /// Attitude and rate.
    pub state: SpinState,
    /// How the state's tangent vector changes with (initial rate in rad/s, inertia ratios). An initial attitude error
    /// `d` in inertial axes stays the same `d` for ever and moves nothing else.
    pub sensitivity: Sensitivity,
}

/// States at `times_s` (increasing) of a free body that is in `initial` at the first of them, with sensitivities
/// (variational equations, Runge–Kutta of order 4). `None` if the inertia is singular or the rate is beyond all sense.
pub fn propagate(initial: &SpinState, inertia: &InertiaRatios, times_s: &[f64]) -> Option<Vec<TrajectoryPoint>> {
    let body = FreeBody::new(inertia)?;
    let mut flow = Flow::start(initial);
    let mut points = Vec::with_capacity(times_s.len());
    for (k, &t_s) in times_s.iter().enumerate() {
        if k > 0 {
            flow = flow.advanced(&body, t_s - times_s[k - 1])?;
        }
        points.push(flow.point());
    }
    Some(points)
}

/// Everything that is integrated, or its time derivative.
#[derive(Clone, Copy)]
struct Flow {
    attitude: Quaternion<f64>,
    rate: Vector3<f64>,
    attitude_by_unknowns: SMatrix<f64, 3, 8>,
    rate_by_unknowns: SMatrix<f64, 3, 8>,
}

impl Flow {
    fn start(initial: &SpinState) -> Self {
        Flow {
            attitude: *initial.asteroid_from_inertial.quaternion(),
            rate: initial.rate_in_asteroid_rad_s,
            attitude_by_unknowns: SMatrix::zeros(),
            rate_by_unknowns: SMatrix::identity(),
        }
    }

    fn advanced(self, body: &FreeBody, interval_s: f64) -> Option<Self> {
        let turn = (self.rate.norm() * interval_s / STEP_RAD).ceil().max(1.0);
        if turn.is_nan() || turn > MOST_STEPS {
            return None;
        }
        let h = interval_s / turn;
        let mut flow = self;
        for _ in 0..turn as usize {
            flow = flow.runge_kutta_step(body, h);
        }
        flow.rate.iter().all(|w| w.is_finite()).then_some(flow)
    }

    fn runge_kutta_step(&self, body: &FreeBody, h: f64) -> Self {
        let k1 = self.derivative(body);
        let k2 = self.moved(&k1, 0.5 * h).derivative(body);
        let k3 = self.moved(&k2, 0.5 * h).derivative(body);
        let k4 = self.moved(&k3, h).derivative(body);
        let mut next = self.moved(&k1, h / 6.0).moved(&k2, h / 3.0).moved(&k3, h / 3.0).moved(&k4, h / 6.0);
        next.attitude = next.attitude.normalize();
        next
    }

    /// `q̇ = -½ ω q` (Hamilton, asteroid_from_inertial: Ȧ = -[ω×] A); with `A = Â exp(d)`, `ḋ = -Âᵀ δω`.
    fn derivative(&self, body: &FreeBody) -> Self {
        let inertial_from_asteroid = UnitQuaternion::from_quaternion(self.attitude).inverse().to_rotation_matrix();
        let mut rate_by_unknowns = body.acceleration_by_rate(&self.rate) * self.rate_by_unknowns;
        let by_inertia = body.acceleration_by_inertia(&self.rate);
        for column in 0..5 {
            let sum = rate_by_unknowns.column(column + 3) + by_inertia.column(column);
            rate_by_unknowns.set_column(column + 3, &sum);
        }
        Flow {
            attitude: Quaternion::from_imag(self.rate * -0.5) * self.attitude,
            rate: body.acceleration_rad_s2(&self.rate),
            attitude_by_unknowns: inertial_from_asteroid.matrix() * self.rate_by_unknowns * -1.0,
            rate_by_unknowns,
        }
    }

    fn moved(&self, slope: &Flow, h: f64) -> Self {
        Flow {
            attitude: self.attitude + slope.attitude * h,
            rate: self.rate + slope.rate * h,
            attitude_by_unknowns: self.attitude_by_unknowns + slope.attitude_by_unknowns * h,
            rate_by_unknowns: self.rate_by_unknowns + slope.rate_by_unknowns * h,
        }
    }

    fn point(&self) -> TrajectoryPoint {
        let mut sensitivity = Sensitivity::zeros();
        sensitivity.fixed_rows_mut::<3>(0).copy_from(&self.attitude_by_unknowns);
        sensitivity.fixed_rows_mut::<3>(3).copy_from(&self.rate_by_unknowns);
        let state = SpinState {
            asteroid_from_inertial: UnitQuaternion::from_quaternion(self.attitude),
            rate_in_asteroid_rad_s: self.rate,
        };
        TrajectoryPoint { state, sensitivity }
    }
}
