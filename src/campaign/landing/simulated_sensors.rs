//! The truth of a flight and what its sensors make of it.

use super::options::CampaignOptions;
use crate::dataset::InitialState;
use crate::geometry::so3::{exp, log, tangent_basis};
use crate::navigation::landing::{BearingObservation, ImuIncrement, Planet};
use crate::scene::{DescentMotion, PolynomialGuidance};
use nalgebra::{Isometry3, SMatrix, SVector, Unit, UnitQuaternion, Vector3};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// True state of the lander.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrueState {
    /// Position in the site frame, m.
    pub position_m: Vector3<f64>,
    /// Velocity in the site frame, m/s.
    pub velocity_m_s: Vector3<f64>,
    /// Attitude.
    pub lander_from_site: UnitQuaternion<f64>,
}

impl TrueState {
    /// The state at a time of a descent.
    pub fn at(motion: &DescentMotion, t_s: f64) -> Self {
        TrueState {
            position_m: motion.path().position_in_site_m(t_s),
            velocity_m_s: motion.path().velocity_in_site_m_s(t_s),
            lander_from_site: motion.site_from_lander(t_s).inverse(),
        }
    }

    /// The motion to a later state as a perfect IMU gives it, without covariance. With E = exp(ω T) and u = v + ω×r, in axes
    /// that do not turn: E r_j = r_i + u_i T + ½ g T² + C_iᵀ Δp, E u_j = u_i + g T + C_iᵀ Δv, C_j = M C_i E.
    pub fn increment_to(&self, to: &TrueState, duration_s: f64, planet: &Planet) -> ImuIncrement {
        let rate = planet.rate_in_site_rad_s;
        let (turn, half_turn) = (exp(&(rate * duration_s)), exp(&(rate * (0.5 * duration_s))));
        let gained_m_s = half_turn * planet.gravity_in_site_m_s2 * duration_s;
        let inertial = |state: &TrueState| state.velocity_m_s + rate.cross(&state.position_m);
        let moved_m = turn * to.position_m - self.position_m - inertial(self) * duration_s;
        ImuIncrement {
            duration_s,
            before_from_after: self.lander_from_site * turn * to.lander_from_site.inverse(),
            velocity_in_before_m_s: self.lander_from_site * (turn * inertial(to) - inertial(self) - gained_m_s),
            position_in_before_m: self.lander_from_site * (moved_m - gained_m_s * (0.5 * duration_s)),
            ..ImuIncrement::identity()
        }
    }

    /// Error, true less estimated, of position (m), velocity (m/s) and attitude ψ (rad), all in site axes.
    pub fn error_of(
        &self,
        site_from_lander: &Isometry3<f64>,
        lander_velocity_in_site_m_s: &Vector3<f64>,
    ) -> SVector<f64, 9> {
        let psi = log(&(self.lander_from_site.inverse() * site_from_lander.rotation.inverse()));
        let mut error = SVector::<f64, 9>::zeros();
        error.fixed_rows_mut::<3>(0).copy_from(&(self.position_m - site_from_lander.translation.vector));
        error.fixed_rows_mut::<3>(3).copy_from(&(self.velocity_m_s - lander_velocity_in_site_m_s));
        error.fixed_rows_mut::<3>(6).copy_from(&psi);
        error
    }
}

/// The true states, once a second.
pub fn true_states(options: &CampaignOptions) -> Vec<TrueState> {
    let motion = DescentMotion::new(PolynomialGuidance::new(&options.guidance));
    let seconds = options.guidance.duration_s.floor() as u32;
    (0..=seconds).map(|t_s| TrueState::at(&motion, f64::from(t_s))).collect()
}

/// The noise of an IMU over a step of the filter: one draw of rate and of force, 1σ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepNoise {
    /// 1σ of the rate, rad/s.
    pub sigma_rate_rad_s: f64,
    /// 1σ of the specific force, m/s².
    pub sigma_force_m_s2: f64,
}

impl StepNoise {
    /// The noise that a campaign draws.
    pub fn of(options: &CampaignOptions) -> Self {
        StepNoise {
            sigma_rate_rad_s: options.sigma_rate_deg_s.to_radians(),
            sigma_force_m_s2: options.sigma_force_m_s2,
        }
    }

    /// An exact increment with the covariance of this noise.
    pub fn stated(&self, exact: &ImuIncrement) -> ImuIncrement {
        let by_unit = self.by_unit(exact.duration_s);
        ImuIncrement { covariance: by_unit * by_unit.transpose(), ..exact.clone() }
    }

    /// The increment as the IMU measures it.
    pub fn measured(&self, exact: &ImuIncrement, random: &mut ChaCha8Rng) -> ImuIncrement {
        let unit = SVector::<f64, 6>::from_fn(|_, _| StandardNormal.sample(random));
        exact.adjusted(&-(self.by_unit(exact.duration_s) * unit))
    }

    /// Errors of an increment by unit noise.
    fn by_unit(&self, duration_s: f64) -> SMatrix<f64, 9, 6> {
        let force_s = self.sigma_force_m_s2 * duration_s;
        let mut by_unit = SMatrix::<f64, 9, 6>::zeros();
        by_unit.fixed_view_mut::<3, 3>(0, 0).fill_diagonal(self.sigma_rate_rad_s * duration_s);
        by_unit.fixed_view_mut::<3, 3>(3, 3).fill_diagonal(force_s);
        by_unit.fixed_view_mut::<3, 3>(6, 3).fill_diagonal(0.5 * force_s * duration_s);
        by_unit
    }
}

/// The direction of a point, exactly.
pub fn exact_direction(truth: &TrueState, point_m: &Vector3<f64>) -> Unit<Vector3<f64>> {
    Unit::new_normalize(truth.lander_from_site * (point_m - truth.position_m))
}

/// A bearing with noise across it; now and then one that is wrong by up to 20°.
pub fn measured_bearing(
    truth: &TrueState,
    (track_id, point_m): (u64, &Vector3<f64>),
    options: &CampaignOptions,
    random: &mut ChaCha8Rng,
) -> BearingObservation {
    let exact = exact_direction(truth, point_m);
    let mut unit = || -> f64 { StandardNormal.sample(random) };
    let noise = nalgebra::Vector2::new(unit(), unit()) * options.sigma_bearing_rad;
    let mut turn = tangent_basis(&exact) * noise;
    if options.outlier_share > 0.0 && random.random_bool(options.outlier_share) {
        let half = 20f64.to_radians();
        let wrong = nalgebra::Vector2::from_fn(|_, _| random.random_range(-half..half));
        turn = tangent_basis(&exact) * wrong;
    }
    let measured = Unit::new_normalize(exact.into_inner() + turn);
    BearingObservation::from_sigma(track_id, measured, options.sigma_bearing_rad)
}

/// What the lander believes at the start: errors uniform in ±1000 m, ±10 m/s, ±2° an axis.
pub fn uncertain_start(start: &TrueState, random: &mut ChaCha8Rng) -> InitialState {
    let mut uniform = |half: f64| Vector3::from_fn(|_, _| random.random_range(-half..half));
    let (position, velocity, psi) = (uniform(1000.0), uniform(10.0), uniform(2f64.to_radians()));
    let root = 3f64.sqrt();
    InitialState {
        t_ns: 0,
        site_from_lander: Isometry3::from_parts(
            (start.position_m - position).into(),
            exp(&-psi) * start.lander_from_site.inverse(),
        ),
        lander_velocity_in_site_m_s: start.velocity_m_s - velocity,
        sigma_position_m: 1000.0 / root,
        sigma_velocity_m_s: 10.0 / root,
        sigma_attitude_rad: 2f64.to_radians() / root,
    }
}
