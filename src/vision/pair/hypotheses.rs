//! Candidate motions of an image pair, ranked by their likelihood.

use super::config::RotationConfig;
use super::covariance::{cells, sums_by_cell};
use super::models::{Plane, Turn};
use super::normalized_match::NormalizedMatch;
use super::plane::{ReliefPlane, ReliefPlaneFit, fit_relief_plane, plane_of_motion};
use super::robust_fit::{PairFit, fit};
use super::solution::PairHints;
use super::usac;
use nalgebra::{Matrix3, Rotation3, SVector, Unit, UnitQuaternion, Vector3};

/// A fitted ground with its cost.
#[derive(Debug, Clone)]
pub(super) struct RankedHypothesis {
    pub(super) fit: ReliefPlaneFit,
    /// `-2 ln` of the likelihood of all matches.
    pub(super) cost: f64,
    costs: Vec<f64>,
}

/// All fitted motions of a pair.
pub(super) struct Hypotheses {
    /// Motions with a translation, the likeliest first.
    pub(super) grounds: Vec<RankedHypothesis>,
    turn: Option<UnitQuaternion<f64>>,
}

/// Matches used to bring starts near; they are refined on all.
const SCREENING: usize = 200;
/// Motions whose rotations differ by less are the same, rad.
const SAME_RAD: f64 = 1e-4;
/// A start that costs so much more than the best on the few matches cannot be its rival on all.
const HOPELESS: f64 = 150.0;
/// A rival is clearly worse beyond this many σ.
const CLEAR_SIGMA: f64 = 3.0;

impl Hypotheses {
    pub(super) fn new(
        normalized: &[NormalizedMatch],
        widest: f64,
        (homography, essential): (Option<&Matrix3<f64>>, Option<&Matrix3<f64>>),
        (hints, config): (&PairHints, &RotationConfig),
    ) -> Self {
        let planes = homography.map(usac::planes).unwrap_or_default();
        let motions = essential.map(usac::motions).unwrap_or_default();
        let small = |q: &UnitQuaternion<f64>| q.angle() < config.max_angle_rad;
        let plane_of = |m: &super::models::General| plane_of_motion(m, normalized, widest);
        let mut starts: Vec<ReliefPlane> = planes.iter().map(ground_of).collect();
        starts.extend(motions.iter().filter(|m| small(&m.rotation)).filter_map(plane_of));
        starts.retain(|g| small(&g.rotation) && is_visible(g, normalized));
        let turn = hints.camera_to_from_camera_from.or(homography.and_then(nearest_turn));
        Hypotheses { grounds: ranked(&starts, normalized, widest), turn }
    }

    /// The pure turn, where a translation explains the matches no better than its parameters by chance (Schwarz 1978).
    pub(super) fn turn_alone(
        &self,
        (normalized, widest): (&[NormalizedMatch], f64),
        enough: usize,
    ) -> Option<PairFit<3, Turn>> {
        let few = thinned(normalized);
        let near = fit(Turn(self.turn?), &few, widest);
        if !self.is_needless(&near, &few) {
            return None;
        }
        let turn = fit(near.model, normalized, widest);
        (turn.inlier_count() >= enough && self.is_needless(&turn, normalized)).then_some(turn)
    }

    /// Whether a translation explains the matches no better than a turn.
    fn is_needless(&self, turn: &PairFit<3, Turn>, normalized: &[NormalizedMatch]) -> bool {
        const MORE_PARAMETERS: f64 = 5.0;
        let total = |fit: &ReliefPlaneFit| fit.costs(normalized).iter().sum::<f64>();
        let allowance = MORE_PARAMETERS * (normalized.len() as f64).ln();
        let alone = total(&without_translation(turn, normalized));
        self.grounds.first().is_none_or(|best| alone < total(&best.fit) + allowance)
    }

    /// The likeliest motion, then those with another rotation that do not explain the matches clearly worse.
    pub(super) fn rivals(&self, normalized: &[NormalizedMatch]) -> Vec<&RankedHypothesis> {
        let Some(best) = self.grounds.first() else { return Vec::new() };
        let sigma_rad = best.fit.rotation_covariance(normalized).map_or(0.0, |c| c.trace().max(0.0).sqrt());
        let apart_rad = (3.0 * sigma_rad).max(10.0 * SAME_RAD);
        let apart = |r: &&RankedHypothesis| r.fit.ground.rotation.angle_to(&best.fit.ground.rotation) > apart_rad;
        let as_good = |r: &&RankedHypothesis| self.surprise(r, normalized) < CLEAR_SIGMA.powi(2);
        let others = self.grounds[1..].iter().filter(|r| apart(r) && as_good(r));
        std::iter::once(best).chain(others).collect()
    }

    /// By how much a motion is less likely than the best, as the square of a normal deviation.
    pub(super) fn surprise(&self, motion: &RankedHypothesis, normalized: &[NormalizedMatch]) -> f64 {
        let Some(best) = self.grounds.first() else { return 0.0 };
        worse_by_sigma(&motion.costs, &best.costs, normalized).powi(2).min(motion.cost - best.cost)
    }
}

/// Grounds fitted from all starts, each once, the likeliest first; the twins of the likeliest are starts too.
fn ranked(starts: &[ReliefPlane], normalized: &[NormalizedMatch], widest: f64) -> Vec<RankedHypothesis> {
    let few = thinned(normalized);
    let mut near: Vec<RankedHypothesis> = Vec::with_capacity(starts.len() + 1);
    starts.iter().for_each(|start| add(&mut near, start, (&few, widest), 3));
    let twins = near.iter().min_by(by_cost).map(|r| usac::planes(&r.fit.ground.homography())).unwrap_or_default();
    let twins = twins.iter().map(ground_of).filter(|g| is_visible(g, normalized));
    twins.for_each(|start| add(&mut near, &start, (&few, widest), 3));
    near.sort_by(by_cost);
    let hopeless = near.first().map_or(0.0, |best| best.cost + HOPELESS);
    let mut all = Vec::with_capacity(near.len());
    near.iter().filter(|r| r.cost < hopeless).for_each(|r| add(&mut all, &r.fit.ground, (normalized, widest), 4));
    all.sort_by(by_cost);
    all
}

fn by_cost<R: std::borrow::Borrow<RankedHypothesis>>(a: &R, b: &R) -> std::cmp::Ordering {
    a.borrow().cost.total_cmp(&b.borrow().cost)
}

fn thinned(normalized: &[NormalizedMatch]) -> Vec<NormalizedMatch> {
    normalized.iter().step_by(normalized.len().div_ceil(SCREENING)).copied().collect()
}

/// Hypotheses a ground; nothing is added where that is one of those that are known.
fn add(
    all: &mut Vec<RankedHypothesis>,
    start: &ReliefPlane,
    (normalized, widest): (&[NormalizedMatch], f64),
    rounds: usize,
) {
    let known = |g: &ReliefPlane| all.iter().any(|r| r.fit.ground.rotation.angle_to(&g.rotation) < SAME_RAD);
    if known(start) {
        return;
    }
    let fit = fit_relief_plane(start, normalized, widest, rounds);
    if !known(&fit.ground) {
        let costs = fit.costs(normalized);
        all.push(RankedHypothesis { fit, cost: costs.iter().sum(), costs });
    }
}

fn ground_of(plane: &Plane) -> ReliefPlane {
    ReliefPlane {
        rotation: plane.rotation,
        translation: plane.translation,
        normal: plane.normal,
        relief_variance: 0.0,
        noise_variance: 1.0,
    }
}

/// By how many σ one motion explains the matches worse than another (Vuong 1989), cells of the image being independent:
/// neither motion contains the other, so chance makes their costs differ by much more than a χ² of few degrees of freedom.
fn worse_by_sigma(costs: &[f64], best: &[f64], normalized: &[NormalizedMatch]) -> f64 {
    let differences: Vec<SVector<f64, 1>> =
        costs.iter().zip(best).map(|(a, b)| SVector::<f64, 1>::new(a - b)).collect();
    let sums = sums_by_cell(&cells(normalized), &differences);
    let (count, total) = (sums.len() as f64, sums.iter().map(|s| s.x).sum::<f64>());
    let squares: f64 = sums.iter().map(|s| (s.x - total / count).powi(2)).sum();
    total / (squares * count / (count - 1.0).max(1.0)).sqrt().max(1e-12)
}

fn is_visible(ground: &ReliefPlane, normalized: &[NormalizedMatch]) -> bool {
    let ahead = normalized.iter().filter(|s| ground.normal.dot(&s.first_ray()) > 0.0).count();
    ahead * 10 >= normalized.len() * 9
}

/// The rotation nearest to a homography.
fn nearest_turn(h: &Matrix3<f64>) -> Option<UnitQuaternion<f64>> {
    let svd = h.svd(true, true);
    let r = svd.u? * svd.v_t?;
    (r.determinant() > 0.0).then(|| UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(r)))
}

/// A pure rotation as a ground without translation.
fn without_translation(turn: &PairFit<3, Turn>, normalized: &[NormalizedMatch]) -> ReliefPlaneFit {
    let ahead = normalized.iter().map(|s| s.first_ray().normalize()).sum::<Vector3<f64>>();
    let ground = ReliefPlane {
        rotation: turn.model.0,
        translation: Vector3::zeros(),
        normal: Unit::new_normalize(ahead),
        relief_variance: 0.0,
        noise_variance: turn.scale.powi(2),
    };
    ReliefPlaneFit { ground, inliers: turn.inliers.clone() }
}
