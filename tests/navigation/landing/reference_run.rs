//! One run of the reference simulation with the filter's parts taken one by one, so that a mistake can be made in each.

use super::descent::{
    END_S, GRAVITY_IN_SITE_M_S2, PLANET, SIGMA_BEARING_RAD, bearing, exact_increment, noisy_increment, truth,
};
use nalgebra::{DMatrix, SMatrix, SVector, UnitQuaternion, Vector3};
use opnav::campaign::{TrueState, uncertain_start};
use opnav::geometry::so3::hat;
use opnav::navigation::filter::Gate;
use opnav::navigation::landing::{
    Core, CorrectionModel, DescentEstimate, DescentState, FilterKind, ImuIncrement, InitializationModel, LandingConfig,
    correct, initial_estimate, predict, viewpoint, with_landmark, without_landmark,
};
use opnav::navigation::landmark::{GroundPrior, Selector};
use opnav::stats::{normalized_error_squared, random_stream};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

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
    let mut estimate = initial_estimate(&uncertain_start(&truth(0.0), &mut random), &config);
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
        let state = &estimate.state;
        let error = now.error_of(&state.site_from_lander(), &state.lander_velocity_in_site_m_s);
        epochs.push(Epoch { error, covariance: case.kind.site_covariance(&estimate) });
    }
    epochs
}

/// A ground point in a direction of the lander's axes, its height drawn from the ground prior.
fn on_ground(now: &TrueState, direction_in_lander: &Vector3<f64>, random: &mut ChaCha8Rng) -> Option<Vector3<f64>> {
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
