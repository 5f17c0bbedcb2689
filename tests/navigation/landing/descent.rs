//! The reference descent, simulated: quartic position polynomials, thrust along the lander's z axis, yaw 0.

use nalgebra::{DMatrix, Isometry3, SMatrix, SVector, Unit, UnitQuaternion, Vector3};
use opnav::dataset::InitialState;
use opnav::geometry::so3::{exp, hat, log, tangent_basis};
use opnav::navigation::filter::Gate;
use opnav::navigation::landing::{
    BearingObservation, Core, CorrectionModel, DescentEstimate, DescentState, FilterKind, ImuIncrement,
    InitializationModel, LandingConfig, Planet, correct, initial_estimate, predict, viewpoint, with_landmark,
    without_landmark,
};
use opnav::navigation::landmark::{GroundPrior, Selector};
use opnav::stats::{normalized_error_squared, random_stream};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

pub const END_S: f64 = 198.0;
pub const GRAVITY_IN_SITE_M_S2: Vector3<f64> = Vector3::new(0.0, 0.0, -3.711);
pub const PLANET: Planet =
    Planet { gravity_in_site_m_s2: GRAVITY_IN_SITE_M_S2, rate_in_site_rad_s: Vector3::new(0.0, 0.0, 0.0) };
pub const SIGMA_BEARING_RAD: f64 = 1e-3;
const SIGMA_FORCE_M_S2: f64 = 5e-4;
const SIGMA_RATE_RAD_S: f64 = 2.78e-5 * std::f64::consts::PI / 180.0;

const COEFFICIENTS: [[f64; 5]; 3] = [
    [3300.0, -56.0, 0.34343434343, -8.8426351053e-4, 7.7295761e-7],
    [5870.0, -66.0, 0.10162228344, 9.9917654249e-4, -2.9551965e-6],
    [6570.0, -90.0, 0.70812672176, -3.6512971775e-3, 7.69795515e-6],
];

/// True state of the lander.
#[derive(Clone, Copy)]
pub struct Truth {
    pub position_m: Vector3<f64>,
    pub velocity_m_s: Vector3<f64>,
    pub lander_from_site: UnitQuaternion<f64>,
}

pub fn truth(t: f64) -> Truth {
    let derivative = |order: i32| {
        Vector3::from_fn(|axis, _| {
            (order..5)
                .map(|k| {
                    (0..order).map(|j| f64::from(k - j)).product::<f64>()
                        * COEFFICIENTS[axis][k as usize]
                        * t.powi(k - order)
                })
                .sum()
        })
    };
    let up: Vector3<f64> = (derivative(2) - GRAVITY_IN_SITE_M_S2).normalize();
    let site_from_lander = UnitQuaternion::from_euler_angles((-up.y).asin(), up.x.atan2(up.z), 0.0);
    Truth { position_m: derivative(0), velocity_m_s: derivative(1), lander_from_site: site_from_lander.inverse() }
}

pub fn normal3(random: &mut ChaCha8Rng, sigma: f64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| {
        let x: f64 = StandardNormal.sample(random);
        x * sigma
    })
}

/// The exact increment between two times of the truth, without covariance.
pub fn exact_increment(from: &Truth, to: &Truth, t: f64) -> ImuIncrement {
    let g = GRAVITY_IN_SITE_M_S2;
    let fallen_m = from.position_m + from.velocity_m_s * t + g * (0.5 * t * t);
    ImuIncrement {
        duration_s: t,
        before_from_after: from.lander_from_site * to.lander_from_site.inverse(),
        velocity_in_before_m_s: from.lander_from_site * (to.velocity_m_s - from.velocity_m_s - g * t),
        position_in_before_m: from.lander_from_site * (to.position_m - fallen_m),
        ..ImuIncrement::identity()
    }
}

/// The increment as an IMU measures it whose noise is one draw a step.
pub fn noisy_increment(exact: &ImuIncrement, random: &mut ChaCha8Rng) -> ImuIncrement {
    let t = exact.duration_s;
    let mut by_noise = SMatrix::<f64, 9, 6>::zeros();
    by_noise.fixed_view_mut::<3, 3>(0, 0).fill_diagonal(SIGMA_RATE_RAD_S * t);
    by_noise.fixed_view_mut::<3, 3>(3, 3).fill_diagonal(SIGMA_FORCE_M_S2 * t);
    by_noise.fixed_view_mut::<3, 3>(6, 3).fill_diagonal(SIGMA_FORCE_M_S2 * t * t * 0.5);
    let unit = SVector::<f64, 6>::from_fn(|_, _| StandardNormal.sample(random));
    let e = by_noise * unit;
    ImuIncrement {
        duration_s: t,
        before_from_after: exact.before_from_after * exp(&-e.fixed_rows::<3>(0).into_owned()),
        velocity_in_before_m_s: exact.velocity_in_before_m_s - e.fixed_rows::<3>(3),
        position_in_before_m: exact.position_in_before_m - e.fixed_rows::<3>(6),
        covariance: by_noise * by_noise.transpose(),
        ..ImuIncrement::identity()
    }
}

/// The bearing of a point of the site frame with noise across it.
pub fn bearing(truth: &Truth, track_id: u64, point_m: &Vector3<f64>, random: &mut ChaCha8Rng) -> BearingObservation {
    let exact = Unit::new_normalize(truth.lander_from_site * (point_m - truth.position_m));
    let noise = normal3(random, SIGMA_BEARING_RAD);
    let turn = tangent_basis(&exact) * noise.xy();
    let measured = Unit::new_normalize(exact.into_inner() + turn);
    BearingObservation::from_sigma(track_id, measured, SIGMA_BEARING_RAD)
}

/// A prior with errors uniform in ±1000 m, ±10 m/s, ±2° an axis.
pub fn uncertain_start(random: &mut ChaCha8Rng) -> InitialState {
    let start = truth(0.0);
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

/// Error, true less estimated, of position, velocity and attitude in site axes.
pub fn error(truth: &Truth, estimate: &DescentEstimate) -> SVector<f64, 9> {
    pose_error(truth, &estimate.state.site_from_lander(), &estimate.state.lander_velocity_in_site_m_s)
}

/// The same for a pose and a velocity.
pub fn pose_error(
    truth: &Truth,
    site_from_lander: &Isometry3<f64>,
    velocity_in_site_m_s: &Vector3<f64>,
) -> SVector<f64, 9> {
    let psi = log(&(truth.lander_from_site.inverse() * site_from_lander.rotation.inverse()));
    let mut e = SVector::<f64, 9>::zeros();
    e.fixed_rows_mut::<3>(0).copy_from(&(truth.position_m - site_from_lander.translation.vector));
    e.fixed_rows_mut::<3>(3).copy_from(&(truth.velocity_m_s - velocity_in_site_m_s));
    e.fixed_rows_mut::<3>(6).copy_from(&psi);
    e
}

/// What a run varies.
#[derive(Clone, Copy)]
pub struct Case {
    pub kind: FilterKind,
    pub selector: Selector,
    pub landmarks: usize,
    /// Deliberate mistakes, for the negative controls.
    pub mistake: Mistake,
}

#[derive(Clone, Copy, PartialEq)]
pub enum Mistake {
    None,
    /// Φ13 and Φ23 with the paper's printed signs of g.
    PrintedSigns,
    /// A new landmark's prior of 100 m an axis, uncorrelated with the state.
    UncorrelatedLandmark,
}

pub const REFERENCE: Case =
    Case { kind: FilterKind::Hybrid, selector: Selector::DepthError, landmarks: 1, mistake: Mistake::None };

/// One epoch's error and what the filter thinks of it.
pub struct Epoch {
    pub error: SVector<f64, 9>,
    pub covariance: SMatrix<f64, 9, 9>,
}

impl Epoch {
    /// NEES over its 9 degrees of freedom; infinite for a covariance that is not positive definite.
    pub fn nees(&self) -> f64 {
        normalized_error_squared(&self.error, &self.covariance).map_or(f64::INFINITY, |x| x / 9.0)
    }

    /// Converged at touchdown: horizontal < 1 m, z < 40 m, |v| < 0.5 m/s, roll and pitch < 0.1°.
    pub fn converged(&self) -> bool {
        let e = &self.error;
        let tilt = 0.1f64.to_radians();
        e.fixed_rows::<2>(0).norm() < 1.0
            && e[2].abs() < 40.0
            && e.fixed_rows::<3>(3).norm() < 0.5
            && e[6].abs() < tilt
            && e[7].abs() < tilt
    }
}

/// One run of the reference descent: an image a second down to 15 m by the estimate; epochs 0 to 198 s.
pub fn fly(case: &Case, run: u64) -> Vec<Epoch> {
    let mut random = random_stream(2023, "descent", run);
    let config = LandingConfig { filter: case.kind, selector: case.selector, ..LandingConfig::default() };
    let init = InitializationModel { kind: case.kind, camera_in_lander_m: Vector3::zeros(), ground: config.ground };
    let mut estimate = initial_estimate(&uncertain_start(&mut random), &config);
    let mut points: Vec<Vector3<f64>> = vec![Vector3::zeros()];
    let mut epochs = Vec::new();
    for k in 0..=END_S as usize {
        let now = truth(k as f64);
        let mut increment = ImuIncrement::identity();
        if k > 0 {
            increment = noisy_increment(&exact_increment(&truth(k as f64 - 1.0), &now, 1.0), &mut random);
            estimate = moved(&estimate, &increment, case);
        } else {
            increment.duration_s = 1.0;
            increment.velocity_in_before_m_s = now.lander_from_site * -GRAVITY_IN_SITE_M_S2;
        }
        if estimate.state.lander_in_site_m.z > 15.0 {
            // Three images a landmark, the first of which places it; then another takes over.
            while let Some(i) = estimate.state.landmarks.iter().position(|l| l.observations >= 2 || l.gated >= 2) {
                estimate = without_landmark(&estimate, i);
            }
            let tracks = estimate.state.landmarks.iter().map(|l| l.track_id).chain([0]);
            let seen: Vec<_> = tracks.map(|id| bearing(&now, id, &points[id as usize], &mut random)).collect();
            let model = CorrectionModel {
                kind: case.kind,
                gate: Gate { confidence: 1.0 - 1e-9 },
                iterations: if k == 0 { 6 } else { 1 },
                camera_in_lander_m: Vector3::zeros(),
                second_order: true,
            };
            let Some(corrected) = correct(estimate.clone(), &seen, &model) else { break };
            estimate = corrected.estimate;
            for slot in 0..case.landmarks {
                if estimate.state.landmarks.iter().any(|l| l.slot == slot) {
                    continue;
                }
                let view = viewpoint(&estimate, &increment, SIGMA_BEARING_RAD, &config);
                let Some(ideal_m) = case.selector.ideal_landmark_in_site_m(&view, &mut random) else { continue };
                let turn = UnitQuaternion::from_axis_angle(
                    &Vector3::z_axis(),
                    slot as f64 * std::f64::consts::TAU / case.landmarks as f64,
                );
                let wanted = turn * (ideal_m - view.lander_in_site_m);
                let Some(point_m) = on_ground(&now, &(estimate.state.lander_from_site * wanted), &mut random) else {
                    continue;
                };
                points.push(point_m);
                let first = bearing(&now, points.len() as u64 - 1, &point_m, &mut random);
                estimate = with_landmark(&estimate, &first, slot, &init).unwrap_or(estimate);
                if case.mistake == Mistake::UncorrelatedLandmark {
                    forget_correlations(&mut estimate);
                }
            }
        }
        epochs.push(Epoch { error: error(&now, &estimate), covariance: case.kind.site_covariance(&estimate) });
    }
    epochs
}

/// A ground point in a direction of the lander's axes, its height drawn from the ground prior.
fn on_ground(now: &Truth, direction_in_lander: &Vector3<f64>, random: &mut ChaCha8Rng) -> Option<Vector3<f64>> {
    let u = now.lander_from_site.inverse() * direction_in_lander.normalize();
    let at = |height_m: f64| now.position_m + u * ((height_m - now.position_m.z) / u.z);
    let unit: f64 = StandardNormal.sample(random);
    let point_m = at(unit * GroundPrior::default().sigma_at_m(&at(0.0)));
    (u.z < 0.0 && (point_m - now.position_m).z < -1.0).then_some(point_m)
}

fn moved(estimate: &DescentEstimate, increment: &ImuIncrement, case: &Case) -> DescentEstimate {
    let right = predict(estimate.clone(), increment, &PLANET, case.kind);
    if case.mistake != Mistake::PrintedSigns {
        return right;
    }
    let wrong = printed_transition(&estimate.state, &right.state, increment);
    let by_noise = case.kind.transition(&Core::of(&estimate.state), &right.state, increment, &PLANET).noise_matrix();
    let covariance =
        &wrong * &estimate.covariance * wrong.transpose() + &by_noise * increment.covariance * by_noise.transpose();
    DescentEstimate { covariance, ..right }
}

/// Φ with Φ13 and Φ23 as equations (8) and (9) print them: the signs of g are wrong.
fn printed_transition(before: &DescentState, after: &DescentState, increment: &ImuIncrement) -> DMatrix<f64> {
    let (t, g) = (increment.duration_s, GRAVITY_IN_SITE_M_S2);
    let mut phi = FilterKind::Standard.transition(&Core::of(before), after, increment, &PLANET).state_matrix();
    let site_from_lander = before.lander_from_site.inverse().to_rotation_matrix().into_inner();
    let moved_m = before.lander_in_site_m - after.lander_in_site_m + before.lander_velocity_in_site_m_s * t;
    let gained_m_s = before.lander_velocity_in_site_m_s - after.lander_velocity_in_site_m_s;
    phi.fixed_view_mut::<3, 3>(0, 6).copy_from(&(hat(&(moved_m - g * (0.5 * t * t))) * site_from_lander));
    phi.fixed_view_mut::<3, 3>(3, 6).copy_from(&(hat(&(gained_m_s - g * t)) * site_from_lander));
    phi
}

fn forget_correlations(estimate: &mut DescentEstimate) {
    let n = estimate.covariance.nrows();
    estimate.covariance.rows_mut(n - 3, 3).fill(0.0);
    estimate.covariance.columns_mut(n - 3, 3).fill(0.0);
    for k in n - 3..n {
        estimate.covariance[(k, k)] = 100.0 * 100.0;
    }
}
