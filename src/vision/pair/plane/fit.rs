//! Maximum likelihood of a plane with relief, by scoring on the matches that agree.

use super::model::{Axes, Information, PARAMETERS, Parameters, RELIEF, ReliefPlane};
use super::start::with_variances;
use crate::stats::{LeastSquares, LeastSquaresOptions, NormalEquations, Steps, minimize};
use crate::vision::pair::covariance::{cells, covariance_of_rotation};
use crate::vision::pair::normalized_match::NormalizedMatch;
use nalgebra::{Const, Matrix3};

/// A match further off than this many σ (two degrees of freedom) is wrong: the tail is below 0.3 %.
pub(super) const GATE_SIGMA: f64 = 3.45;

/// A ground fitted to the matches that agree with it.
#[derive(Debug, Clone)]
pub struct ReliefPlaneFit {
    pub ground: ReliefPlane,
    /// Which matches agree.
    pub inliers: Vec<bool>,
}

/// Scoring with halved steps.
const SCORING: LeastSquaresOptions = LeastSquaresOptions {
    steps: Steps::Halved(6),
    most_steps: 10,
    least_step: 0.0,
    least_drop_share: 0.0,
    least_drop: 1e-2,
};

/// The matches that agree with a ground.
struct Agreeing<'a> {
    normalized: &'a [NormalizedMatch],
    inliers: &'a [bool],
}

impl ReliefPlaneFit {
    /// Matches that agree.
    pub fn inlier_count(&self) -> usize {
        self.inliers.iter().filter(|i| **i).count()
    }

    /// Actual noise over nominal noise.
    pub fn scale(&self) -> f64 {
        self.ground.noise_variance.sqrt()
    }

    /// The matches that agree.
    pub fn agreeing(&self, normalized: &[NormalizedMatch]) -> Vec<NormalizedMatch> {
        normalized.iter().zip(&self.inliers).filter(|(_, inlier)| **inlier).map(|(s, _)| *s).collect()
    }

    /// `-2 ln` of the likelihood of each match, none counting beyond the gate.
    pub fn costs(&self, normalized: &[NormalizedMatch]) -> Vec<f64> {
        const BEHIND: (f64, f64) = (f64::INFINITY, 0.0);
        let homography = self.ground.homography();
        let cost = |s: &NormalizedMatch| {
            let (square, ln_determinant) = self.ground.misfit(&homography, s).unwrap_or(BEHIND);
            square.min(GATE_SIGMA * GATE_SIGMA) + ln_determinant
        };
        normalized.iter().map(cost).collect()
    }

    /// Covariance (rad²) of the rotation, all else marginalised and neighbouring matches erring together; `None` where it
    /// is not determined.
    pub fn rotation_covariance(&self, normalized: &[NormalizedMatch]) -> Option<Matrix3<f64>> {
        let agreeing = self.agreeing(normalized);
        let axes = Axes::of(&self.ground);
        let mut information = Information::zeros();
        let mut scores = Vec::with_capacity(agreeing.len());
        for matched in &agreeing {
            let evidence = self.ground.evidence(&axes, matched)?;
            information += evidence.information();
            scores.push(evidence.score());
        }
        if self.ground.relief_variance <= 0.0 {
            hold_relief(&mut information);
            scores.iter_mut().for_each(|s| s[RELIEF] = 0.0);
        }
        covariance_of_rotation(&information.cholesky()?.inverse(), &scores, &cells(&agreeing))
    }
}

/// Takes the relief's variance out of the unknowns.
fn hold_relief(information: &mut Information) {
    information.row_mut(RELIEF).fill(0.0);
    information.column_mut(RELIEF).fill(0.0);
    information[(RELIEF, RELIEF)] = 1.0;
}

/// Hypotheses a ground from a start, first to matches within `widest` (units of the nominal σ) of the start's epipolar lines.
pub fn fit_relief_plane(
    start: &ReliefPlane,
    normalized: &[NormalizedMatch],
    widest: f64,
    rounds: usize,
) -> ReliefPlaneFit {
    let mut ground = with_variances(start, normalized, widest);
    let mut inliers = agreeing(&ground, normalized);
    for _ in 0..rounds {
        ground = minimize(&Agreeing { normalized, inliers: &inliers }, ground, &SCORING).state;
        let next = agreeing(&ground, normalized);
        let settled = next == inliers;
        inliers = next;
        if settled {
            break;
        }
    }
    ReliefPlaneFit { ground, inliers }
}

fn agreeing(ground: &ReliefPlane, normalized: &[NormalizedMatch]) -> Vec<bool> {
    let homography = ground.homography();
    let near = |s: &NormalizedMatch| ground.misfit(&homography, s).is_some_and(|(d2, _)| d2 < GATE_SIGMA * GATE_SIGMA);
    normalized.iter().map(near).collect()
}

impl Agreeing<'_> {
    fn iter(&self) -> impl Iterator<Item = &NormalizedMatch> {
        self.normalized.iter().zip(self.inliers).filter(|(_, inlier)| **inlier).map(|(matched, _)| matched)
    }
}

impl LeastSquares for Agreeing<'_> {
    type Size = Const<PARAMETERS>;
    type State = ReliefPlane;

    /// Score and information; relief that would become negative stays at nothing.
    fn normal_equations(&self, ground: &ReliefPlane) -> NormalEquations<Const<PARAMETERS>> {
        let axes = Axes::of(ground);
        let (mut information, mut right_side, mut cost) = (Information::zeros(), Parameters::zeros(), 0.0);
        for evidence in self.iter().filter_map(|matched| ground.evidence(&axes, matched)) {
            cost += evidence.cost;
            right_side += evidence.score();
            information += evidence.information();
        }
        if ground.relief_variance <= 0.0 && right_side[RELIEF] <= 0.0 {
            hold_relief(&mut information);
            right_side[RELIEF] = 0.0;
        }
        for j in 0..PARAMETERS {
            information[(j, j)] *= 1.0 + 1e-6;
            information[(j, j)] += 1e-9;
        }
        NormalEquations { information, right_side, cost }
    }

    fn cost(&self, ground: &ReliefPlane) -> f64 {
        let homography = ground.homography();
        let of = |s: &NormalizedMatch| ground.misfit(&homography, s).map_or(1e9, |(d2, ln_det)| d2 + ln_det);
        self.iter().map(of).sum()
    }

    fn moved(&self, ground: &ReliefPlane, step: &Parameters) -> Option<ReliefPlane> {
        Some(ground.moved(step))
    }
}
