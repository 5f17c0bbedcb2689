//! The truth of a flight and what its sensors make of it.

use super::options::CampaignOptions;
use crate::dataset::InitialState;
use crate::geometry::so3::{exp, tangent_basis};
use crate::navigation::landing::{BearingObservation, ImuIncrement};
use crate::scene::{DescentMotion, PolynomialGuidance};
use nalgebra::{Isometry3, SMatrix, SVector, Unit, UnitQuaternion, Vector3};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// True state of the lander at one second of the flight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrueState {
    /// Position in the site frame, m.
    pub position_m: Vector3<f64>,
    /// Velocity in the site frame, m/s.
    pub velocity_m_s: Vector3<f64>,
    /// Attitude.
    pub lander_from_site: UnitQuaternion<f64>,
}

/// The true states, once a second.
pub fn true_states(options: &CampaignOptions) -> Vec<TrueState> {
    let motion = DescentMotion::new(PolynomialGuidance::new(&options.guidance));
    let seconds = options.guidance.duration_s.floor() as u32;
    (0..=seconds)
        .map(|t| TrueState {
            position_m: motion.path().position_in_site_m(f64::from(t)),
            velocity_m_s: motion.path().velocity_in_site_m_s(f64::from(t)),
            lander_from_site: motion.site_from_lander(f64::from(t)).inverse(),
        })
        .collect()
}

/// The motion of the lander from one second to the next as a perfect IMU gives it, with the covariance of the real one.
/// With E = exp(ω T) and u = v + ω×r, in axes that do not turn: E r_j = r_i + u_i T + ½ g T² + C_iᵀ Δp,
/// E u_j = u_i + g T + C_iᵀ Δv, C_j = M C_i E.
pub fn exact_increment(from: &TrueState, to: &TrueState, options: &CampaignOptions) -> ImuIncrement {
    let planet = options.planet();
    let rate = planet.rate_in_site_rad_s;
    let (turn, half_turn) = (exp(&rate), exp(&(rate * 0.5)));
    let g = half_turn * planet.gravity_in_site_m_s2;
    let inertial = |state: &TrueState| state.velocity_m_s + rate.cross(&state.position_m);
    let by_noise = by_noise(options);
    ImuIncrement {
        duration_s: 1.0,
        before_from_after: from.lander_from_site * turn * to.lander_from_site.inverse(),
        velocity_in_before_m_s: from.lander_from_site * (turn * inertial(to) - inertial(from) - g),
        position_in_before_m: from.lander_from_site
            * (turn * to.position_m - from.position_m - inertial(from) - g * 0.5),
        covariance: by_noise * by_noise.transpose(),
        ..ImuIncrement::identity()
    }
}

/// Errors of an increment of 1 s by unit noise: one draw of rate and force a step.
fn by_noise(options: &CampaignOptions) -> SMatrix<f64, 9, 6> {
    let mut by_noise = SMatrix::<f64, 9, 6>::zeros();
    by_noise.fixed_view_mut::<3, 3>(0, 0).fill_diagonal(options.sigma_rate_deg_s.to_radians());
    by_noise.fixed_view_mut::<3, 3>(3, 3).fill_diagonal(options.sigma_force_m_s2);
    by_noise.fixed_view_mut::<3, 3>(6, 3).fill_diagonal(0.5 * options.sigma_force_m_s2);
    by_noise
}

/// The increment as the IMU measures it.
pub fn measured_increment(exact: &ImuIncrement, options: &CampaignOptions, random: &mut ChaCha8Rng) -> ImuIncrement {
    let unit = SVector::<f64, 6>::from_fn(|_, _| StandardNormal.sample(random));
    exact.adjusted(&-(by_noise(options) * unit))
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
