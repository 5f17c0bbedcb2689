//! The extended Kalman filter of Deng et al. (2024) on the chained attitude: the baseline.
//!
//! Errata that are put right: the pairs' chain (equation 9) gives the transpose of the attitude (equation 10), so the
//! measurement is `A_k = A_{k-1} R_Δkᵀ`; the error is multiplicative in the update too (the printed `Z - h(X)` fails near
//! half a turn). What is kept: the measurement errors are taken as independent though they add up along the chain, so the
//! covariance is too small; and the filter reports inertia even where the motion does not show it.

use crate::geometry::so3::{exp, hat};
use crate::navigation::tumbling::config::{PaperConfig, PaperIntegration};
use crate::navigation::tumbling::estimate::symmetric;
use crate::navigation::tumbling::motion::{FreeBody, InertiaRatios, SpinState, propagate};
use crate::navigation::tumbling::pair::RotationPair;
use crate::navigation::tumbling::result::{InertiaKnowledge, TumblingEpoch};
use nalgebra::{Matrix3, Quaternion, SMatrix, UnitQuaternion, Vector3};

type Matrix11 = SMatrix<f64, 11, 11>;

/// The filter: state, and covariance of (δq_v, δω, δl) with Shuster's error quaternion `q = δq ⊗ q̂`, so that
/// `A = (I - 2 [δq_v×]) Â` for `A = asteroid_from_inertial`.
#[derive(Debug, Clone)]
pub struct PaperFilter {
    state: SpinState,
    inertia: InertiaRatios,
    covariance: Matrix11,
    config: PaperConfig,
}

impl PaperFilter {
    /// The filter before the first picture.
    pub fn new(config: &PaperConfig) -> Self {
        PaperFilter {
            state: SpinState {
                asteroid_from_inertial: UnitQuaternion::identity(),
                rate_in_asteroid_rad_s: Vector3::from(config.initial_rate_deg_s.map(f64::to_radians)),
            },
            inertia: InertiaRatios(config.initial_inertia),
            covariance: Matrix11::identity() * config.initial_variance,
            config: *config,
        }
    }

    /// Moves the estimate by `dt_s` (equations 34 and 36); `None` if the estimated inertia has become singular.
    pub fn predict(&mut self, dt_s: f64) -> Option<()> {
        let transition = match self.config.integration {
            PaperIntegration::Euler => self.euler_step(dt_s)?,
            PaperIntegration::RungeKutta => self.runge_kutta_step(dt_s)?,
        };
        let noise = Matrix11::identity() * self.config.process_variance;
        self.covariance = symmetric(&(transition * self.covariance * transition.transpose() + noise));
        Some(())
    }

    /// Corrects by a measured attitude `asteroid_from_inertial`, and returns the innovation squared over its covariance;
    /// `None` if the covariance is no longer one.
    pub fn correct(&mut self, measured: &UnitQuaternion<f64>) -> Option<f64> {
        let turn = measured * self.state.asteroid_from_inertial.inverse();
        let innovation = turn.imag() * if turn.w < 0.0 { 1.0 } else { -1.0 };
        let h_p = self.covariance.fixed_rows::<3>(0).into_owned();
        let s = h_p.fixed_columns::<3>(0) + Matrix3::identity() * self.config.measurement_variance;
        let s_inverse = s.cholesky()?.inverse();
        let gain = h_p.transpose() * s_inverse;
        let correction = gain * innovation;
        self.covariance = symmetric(&(self.covariance - gain * h_p));
        let half_angles = correction.fixed_rows::<3>(0).into_owned();
        self.state.asteroid_from_inertial = exp(&(half_angles * -2.0)) * self.state.asteroid_from_inertial;
        self.state.rate_in_asteroid_rad_s += correction.fixed_rows::<3>(3);
        self.inertia = InertiaRatios(std::array::from_fn(|i| self.inertia.0[i] + correction[6 + i]));
        Some(innovation.dot(&(s_inverse * innovation)))
    }

    /// The estimate, with the covariance turned to the error convention of [`SpinState`].
    pub fn epoch(&self, t_ns: i64) -> TumblingEpoch {
        let asteroid_from_inertial = self.state.asteroid_from_inertial;
        let mut turned = SMatrix::<f64, 6, 6>::identity();
        let inertial_from_asteroid = asteroid_from_inertial.inverse().to_rotation_matrix();
        turned.fixed_view_mut::<3, 3>(0, 0).copy_from(&(inertial_from_asteroid.matrix() * -2.0));
        let covariance = turned * self.covariance.fixed_view::<6, 6>(0, 0) * turned.transpose();
        TumblingEpoch {
            t_ns,
            asteroid_from_inertial,
            rate_in_asteroid_rad_s: self.state.rate_in_asteroid_rad_s,
            covariance: symmetric(&covariance),
            inertia: InertiaKnowledge::new(&self.inertia, &self.inertia_covariance(), &[]),
        }
    }

    /// The estimated inertia ratios.
    pub fn inertia(&self) -> &InertiaRatios {
        &self.inertia
    }

    /// Covariance of the ratios, as the filter believes it.
    pub fn inertia_covariance(&self) -> SMatrix<f64, 5, 5> {
        self.covariance.fixed_view::<5, 5>(6, 6).into_owned()
    }

    /// `X + f(X) ΔT` and `Φ = I + C ΔT` with C of equation 33.
    fn euler_step(&mut self, dt_s: f64) -> Option<Matrix11> {
        let body = FreeBody::new(&self.inertia)?;
        let rate = self.state.rate_in_asteroid_rad_s;
        let mut transition = Matrix11::identity();
        let mut attitude_block = transition.fixed_view_mut::<3, 3>(0, 0);
        attitude_block -= hat(&rate) * dt_s;
        transition.fixed_view_mut::<3, 3>(0, 3).fill_diagonal(0.5 * dt_s);
        let mut rate_block = transition.fixed_view_mut::<3, 3>(3, 3);
        rate_block += body.acceleration_by_rate(&rate) * dt_s;
        transition.fixed_view_mut::<3, 5>(3, 6).copy_from(&(body.acceleration_by_inertia(&rate) * dt_s));
        let attitude = self.state.asteroid_from_inertial.quaternion();
        let moved = attitude + Quaternion::from_imag(rate * -0.5) * attitude * dt_s;
        self.state.asteroid_from_inertial = UnitQuaternion::from_quaternion(moved);
        self.state.rate_in_asteroid_rad_s += body.acceleration_rad_s2(&rate) * dt_s;
        Some(transition)
    }

    fn runge_kutta_step(&mut self, dt_s: f64) -> Option<Matrix11> {
        let next = propagate(&self.state, &self.inertia, &[0.0, dt_s])?.pop()?;
        let after = next.state.asteroid_from_inertial.to_rotation_matrix();
        let before = self.state.asteroid_from_inertial.to_rotation_matrix();
        let mut transition = Matrix11::identity();
        transition.fixed_view_mut::<3, 3>(0, 0).copy_from((after * before.inverse()).matrix());
        let by_unknowns = after.matrix() * next.sensitivity.fixed_rows::<3>(0) * -0.5;
        transition.fixed_view_mut::<3, 8>(0, 3).copy_from(&by_unknowns);
        transition.fixed_view_mut::<3, 8>(3, 3).copy_from(&next.sensitivity.fixed_rows::<3>(3));
        self.state = next.state;
        Some(transition)
    }
}

/// Attitudes from the chain of pairs, `A_k = A_{k-1} R_Δkᵀ`, through the pair with the shortest span into each picture;
/// `None` where no pair leads. Also the number of pairs used.
pub fn chained_attitudes(pairs: &[RotationPair], frames: usize) -> (Vec<Option<UnitQuaternion<f64>>>, usize) {
    let mut attitudes = vec![None; frames];
    attitudes[0] = Some(UnitQuaternion::identity());
    let mut used = 0;
    // Sorted by (to, from): of the pairs into a picture, the last one that starts from a known attitude wins.
    for incoming in pairs.chunk_by(|a, b| a.to == b.to) {
        let found = incoming.iter().rev().find_map(|p| attitudes[p.from].map(|from| from * p.measured.inverse()));
        used += usize::from(found.is_some());
        attitudes[incoming[0].to] = found;
    }
    (attitudes, used)
}
