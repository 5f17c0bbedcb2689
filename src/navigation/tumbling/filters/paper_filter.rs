//! The extended Kalman filter of Deng et al. (2024) on the chained attitude: the baseline.
//!
//! Errata that are put right: the pairs' chain (equation 9) gives the transpose of the attitude (equation 10), so the
//! measurement is `A_k = A_{k-1} R_Δkᵀ`; the error is multiplicative in the update too (the printed `Z - h(X)` fails near
//! half a turn). What is kept: the measurement errors are taken as independent though they add up along the chain, so the
//! covariance is too small; and the filter reports inertia even where the motion does not show it.

use crate::geometry::Manifold;
use crate::geometry::so3::{exp, hat, log};
use crate::navigation::filter::{CorrectionOptions, Innovation, correct_linearized};
use crate::navigation::tumbling::config::{PaperConfig, PaperIntegration};
use crate::navigation::tumbling::motion::{FreeBody, InertiaRatios, SpinState, propagate};
use crate::navigation::tumbling::pair::RotationPair;
use crate::navigation::tumbling::result::{InertiaKnowledge, TumblingEpoch};
use crate::stats::{Estimate, symmetric};
use nalgebra::{Matrix3, Quaternion, SMatrix, SVector, UnitQuaternion, Vector3};

type Matrix11 = SMatrix<f64, 11, 11>;
type Vector11 = SVector<f64, 11>;

/// Attitude, rate and inertia ratios as the paper's filter errs in them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PaperState {
    /// Attitude and rate.
    pub spin: SpinState,
    /// Inertia ratios.
    pub inertia: InertiaRatios,
}

impl Manifold<11> for PaperState {
    /// `d` = (δq_v, δω, δl) with Shuster's error quaternion `q = δq ⊗ q̂`, half an angle, so that `A = exp(-2 δq_v) Â` for
    /// `A = asteroid_from_inertial`.
    fn plus(&self, d: &Vector11) -> Self {
        let half_angles = d.fixed_rows::<3>(0).into_owned();
        PaperState {
            spin: SpinState {
                asteroid_from_inertial: exp(&(half_angles * -2.0)) * self.spin.asteroid_from_inertial,
                rate_in_asteroid_rad_s: self.spin.rate_in_asteroid_rad_s + d.fixed_rows::<3>(3),
            },
            inertia: InertiaRatios(std::array::from_fn(|i| self.inertia.0[i] + d[6 + i])),
        }
    }

    fn minus(&self, other: &Self) -> Vector11 {
        let turn = self.spin.asteroid_from_inertial * other.spin.asteroid_from_inertial.inverse();
        let mut d = Vector11::zeros();
        d.fixed_rows_mut::<3>(0).copy_from(&(log(&turn) * -0.5));
        d.fixed_rows_mut::<3>(3).copy_from(&(self.spin.rate_in_asteroid_rad_s - other.spin.rate_in_asteroid_rad_s));
        d.fixed_rows_mut::<5>(6).copy_from(&(self.inertia.vector() - other.inertia.vector()));
        d
    }
}

/// The filter: its estimate, and how it predicts and corrects. Each gives a new filter.
#[derive(Debug, Clone)]
pub struct PaperFilter {
    estimate: Estimate<PaperState, 11>,
    config: PaperConfig,
}

impl PaperFilter {
    /// The filter before the first image.
    pub fn new(config: &PaperConfig) -> Self {
        let spin = SpinState {
            asteroid_from_inertial: UnitQuaternion::identity(),
            rate_in_asteroid_rad_s: Vector3::from(config.initial_rate_deg_s.map(f64::to_radians)),
        };
        let state = PaperState { spin, inertia: InertiaRatios(config.initial_inertia) };
        let covariance = Matrix11::identity() * config.initial_variance;
        PaperFilter { estimate: Estimate { state, covariance }, config: *config }
    }

    /// The filter `dt_s` later (equations 34 and 36); `None` if the estimated inertia has become singular.
    pub fn predict(&self, dt_s: f64) -> Option<Self> {
        let state = &self.estimate.state;
        let (spin, transition) = match self.config.integration {
            PaperIntegration::Euler => euler_step(state, dt_s)?,
            PaperIntegration::RungeKutta => runge_kutta_step(state, dt_s)?,
        };
        let noise = Matrix11::identity() * self.config.process_variance;
        let covariance = transition * self.estimate.covariance * transition.transpose() + noise;
        let estimate = Estimate { state: PaperState { spin, ..*state }, covariance }.symmetrized();
        Some(PaperFilter { estimate, ..*self })
    }

    /// The filter after a measured attitude `asteroid_from_inertial`, and the innovation squared over its covariance;
    /// `None` if the covariance is no longer one.
    pub fn correct(&self, measured: &UnitQuaternion<f64>) -> Option<(Self, f64)> {
        let turn = measured * self.estimate.state.spin.asteroid_from_inertial.inverse();
        let residual = turn.imag() * if turn.w < 0.0 { 1.0 } else { -1.0 };
        let noise = Matrix3::identity() * self.config.measurement_variance;
        let innovation = Innovation::<3, 3>::dense(residual, Matrix3::identity(), noise);
        let after = correct_linearized(&self.estimate, |_| innovation.clone(), &CorrectionOptions::default())?;
        Some((PaperFilter { estimate: after.estimate, ..*self }, after.normalized_innovation_squared))
    }

    /// The estimate, with the covariance turned to the error convention of [`SpinState`].
    pub fn epoch(&self, t_ns: i64) -> TumblingEpoch {
        let spin = self.estimate.state.spin;
        let mut turned = SMatrix::<f64, 6, 6>::identity();
        let inertial_from_asteroid = spin.asteroid_from_inertial.inverse().to_rotation_matrix();
        turned.fixed_view_mut::<3, 3>(0, 0).copy_from(&(inertial_from_asteroid.matrix() * -2.0));
        let covariance = turned * self.estimate.covariance.fixed_view::<6, 6>(0, 0) * turned.transpose();
        TumblingEpoch {
            t_ns,
            asteroid_from_inertial: spin.asteroid_from_inertial,
            rate_in_asteroid_rad_s: spin.rate_in_asteroid_rad_s,
            covariance: symmetric(&covariance),
            inertia: InertiaKnowledge::new(self.inertia(), &self.inertia_covariance(), &[]),
        }
    }

    /// The estimated inertia ratios.
    pub fn inertia(&self) -> &InertiaRatios {
        &self.estimate.state.inertia
    }

    /// Covariance of the ratios, as the filter believes it.
    pub fn inertia_covariance(&self) -> SMatrix<f64, 5, 5> {
        self.estimate.covariance.fixed_view::<5, 5>(6, 6).into_owned()
    }
}

/// `X + f(X) ΔT` and `Φ = I + C ΔT` with C of equation 33.
fn euler_step(state: &PaperState, dt_s: f64) -> Option<(SpinState, Matrix11)> {
    let body = FreeBody::new(&state.inertia)?;
    let rate = state.spin.rate_in_asteroid_rad_s;
    let mut transition = Matrix11::identity();
    let mut attitude_block = transition.fixed_view_mut::<3, 3>(0, 0);
    attitude_block -= hat(&rate) * dt_s;
    transition.fixed_view_mut::<3, 3>(0, 3).fill_diagonal(0.5 * dt_s);
    let mut rate_block = transition.fixed_view_mut::<3, 3>(3, 3);
    rate_block += body.acceleration_by_rate(&rate) * dt_s;
    transition.fixed_view_mut::<3, 5>(3, 6).copy_from(&(body.acceleration_by_inertia(&rate) * dt_s));
    let attitude = state.spin.asteroid_from_inertial.quaternion();
    let moved = attitude + Quaternion::from_imag(rate * -0.5) * attitude * dt_s;
    let spin = SpinState {
        asteroid_from_inertial: UnitQuaternion::from_quaternion(moved),
        rate_in_asteroid_rad_s: rate + body.acceleration_rad_s2(&rate) * dt_s,
    };
    Some((spin, transition))
}

/// The motion and its sensitivities by Runge and Kutta.
fn runge_kutta_step(state: &PaperState, dt_s: f64) -> Option<(SpinState, Matrix11)> {
    let next = propagate(&state.spin, &state.inertia, &[0.0, dt_s])?.pop()?;
    let after = next.state.asteroid_from_inertial.to_rotation_matrix();
    let before = state.spin.asteroid_from_inertial.to_rotation_matrix();
    let mut transition = Matrix11::identity();
    transition.fixed_view_mut::<3, 3>(0, 0).copy_from((after * before.inverse()).matrix());
    let by_unknowns = after.matrix() * next.sensitivity.fixed_rows::<3>(0) * -0.5;
    transition.fixed_view_mut::<3, 8>(0, 3).copy_from(&by_unknowns);
    transition.fixed_view_mut::<3, 8>(3, 3).copy_from(&next.sensitivity.fixed_rows::<3>(3));
    Some((next.state, transition))
}

/// Attitudes from the chain of pairs, `A_k = A_{k-1} R_Δkᵀ`, through the pair with the shortest span into each image;
/// `None` where no pair leads. Also the number of pairs used.
pub fn chained_attitudes(pairs: &[RotationPair], frames: usize) -> (Vec<Option<UnitQuaternion<f64>>>, usize) {
    let mut attitudes = vec![None; frames];
    attitudes[0] = Some(UnitQuaternion::identity());
    let mut used = 0;
    // Sorted by (to, from): of the pairs into an image, the last one that starts from a known attitude wins.
    for incoming in pairs.chunk_by(|a, b| a.to == b.to) {
        let found = incoming.iter().rev().find_map(|p| attitudes[p.from].map(|from| from * p.measured.inverse()));
        used += usize::from(found.is_some());
        attitudes[incoming[0].to] = found;
    }
    (attitudes, used)
}
