//! The reference descent: its true states and what is measured along it, as the campaigns simulate them.

use nalgebra::Vector3;
use opnav::campaign::{CampaignOptions, StepNoise, TrueState, measured_bearing};
use opnav::navigation::landing::{BearingObservation, ImuIncrement, Planet};
use opnav::scene::{DescentMotion, GuidanceConfig, PolynomialGuidance};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use std::sync::LazyLock;

pub const END_S: f64 = 198.0;
pub const GRAVITY_IN_SITE_M_S2: Vector3<f64> = Vector3::new(0.0, 0.0, -3.711);
pub const PLANET: Planet =
    Planet { gravity_in_site_m_s2: GRAVITY_IN_SITE_M_S2, rate_in_site_rad_s: Vector3::new(0.0, 0.0, 0.0) };
pub const SIGMA_BEARING_RAD: f64 = 1e-3;

static MOTION: LazyLock<DescentMotion> =
    LazyLock::new(|| DescentMotion::new(PolynomialGuidance::new(&GuidanceConfig::default())));
static OPTIONS: LazyLock<CampaignOptions> =
    LazyLock::new(|| CampaignOptions { sigma_bearing_rad: SIGMA_BEARING_RAD, ..CampaignOptions::default() });

pub fn truth(t_s: f64) -> TrueState {
    TrueState::at(&MOTION, t_s)
}

pub fn normal3(random: &mut ChaCha8Rng, sigma: f64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| {
        let x: f64 = StandardNormal.sample(random);
        x * sigma
    })
}

/// The exact increment between two true states, without covariance.
pub fn exact_increment(from: &TrueState, to: &TrueState, duration_s: f64) -> ImuIncrement {
    from.increment_to(to, duration_s, &PLANET)
}

/// The increment as an IMU measures it whose noise is one draw a step.
pub fn noisy_increment(exact: &ImuIncrement, random: &mut ChaCha8Rng) -> ImuIncrement {
    let noise = StepNoise::of(&OPTIONS);
    noise.measured(&noise.stated(exact), random)
}

/// The bearing of a point of the site frame with noise across it.
pub fn bearing(
    truth: &TrueState,
    track_id: u64,
    point_m: &Vector3<f64>,
    random: &mut ChaCha8Rng,
) -> BearingObservation {
    measured_bearing(truth, (track_id, point_m), &OPTIONS, random)
}
