//! Maximum likelihood of a plane with relief, by scoring on the matches that agree.

use super::model::{Axes, Ground, Information, PARAMETERS, Parameters, RELIEF};
use super::start::with_variances;
use crate::vision::pair::covariance::{cells, covariance_of_rotation};
use crate::vision::pair::normalized_match::Sight;
use nalgebra::Matrix3;

/// A match further off than this many σ (two degrees of freedom) is wrong: the tail is below 0.3 %.
pub(super) const GATE_SIGMA: f64 = 3.45;

/// A ground fitted to the matches that agree with it.
#[derive(Debug, Clone)]
pub struct GroundFit {
    pub ground: Ground,
    /// Which matches agree.
    pub inliers: Vec<bool>,
}

/// Sums over the matches that agree.
struct Sums {
    cost: f64,
    score: Parameters,
    information: Information,
}

impl GroundFit {
    /// Matches that agree.
    pub fn inlier_count(&self) -> usize {
        self.inliers.iter().filter(|i| **i).count()
    }

    /// Actual noise over nominal noise.
    pub fn scale(&self) -> f64 {
        self.ground.noise_variance.sqrt()
    }

    /// The matches that agree.
    pub fn agreeing(&self, sights: &[Sight]) -> Vec<Sight> {
        sights.iter().zip(&self.inliers).filter(|(_, inlier)| **inlier).map(|(s, _)| *s).collect()
    }

    /// `-2 ln` of the likelihood of each match, none counting beyond the gate.
    pub fn costs(&self, sights: &[Sight]) -> Vec<f64> {
        const BEHIND: (f64, f64) = (f64::INFINITY, 0.0);
        let homography = self.ground.homography();
        let cost = |s: &Sight| {
            let (square, ln_determinant) = self.ground.misfit(&homography, s).unwrap_or(BEHIND);
            square.min(GATE_SIGMA * GATE_SIGMA) + ln_determinant
        };
        sights.iter().map(cost).collect()
    }

    /// Covariance (rad²) of the rotation, all else marginalised and neighbouring matches erring together; `None` where it
    /// is not determined.
    pub fn rotation_covariance(&self, sights: &[Sight]) -> Option<Matrix3<f64>> {
        let agreeing = self.agreeing(sights);
        let axes = Axes::of(&self.ground);
        let mut information = Information::zeros();
        let mut scores = Vec::with_capacity(agreeing.len());
        for sight in &agreeing {
            let evidence = self.ground.evidence(&axes, sight)?;
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

/// Fits a ground from a start, first to matches within `widest` (units of the nominal σ) of the start's epipolar lines.
pub fn fit_ground(start: &Ground, sights: &[Sight], widest: f64, rounds: usize) -> GroundFit {
    let mut ground = with_variances(start, sights, widest);
    let mut inliers = agreeing(&ground, sights);
    for _ in 0..rounds {
        ground = score(ground, sights, &inliers);
        let next = agreeing(&ground, sights);
        let settled = next == inliers;
        inliers = next;
        if settled {
            break;
        }
    }
    GroundFit { ground, inliers }
}

fn agreeing(ground: &Ground, sights: &[Sight]) -> Vec<bool> {
    let homography = ground.homography();
    let near = |s: &Sight| ground.misfit(&homography, s).is_some_and(|(d2, _)| d2 < GATE_SIGMA * GATE_SIGMA);
    sights.iter().map(near).collect()
}

/// Scoring with halved steps on fixed matches.
fn score(start: Ground, sights: &[Sight], inliers: &[bool]) -> Ground {
    let mut ground = start;
    let mut sums = sums(&ground, sights, inliers);
    for _ in 0..10 {
        let Some(step) = damped_step(&sums, &ground) else { break };
        let mut moved = None;
        for halvings in 0..6 {
            let candidate = ground.moved(&(step * 0.5f64.powi(halvings)));
            if cost(&candidate, sights, inliers) < sums.cost {
                moved = Some(candidate);
                break;
            }
        }
        let Some(next) = moved else { break };
        let gain = sums.cost;
        ground = next;
        sums = self::sums(&ground, sights, inliers);
        if gain - sums.cost < 1e-2 {
            break;
        }
    }
    ground
}

/// Scoring step; relief that would become negative stays at nothing.
fn damped_step(sums: &Sums, ground: &Ground) -> Option<Parameters> {
    let mut information = sums.information;
    let mut score = sums.score;
    if ground.relief_variance <= 0.0 && score[RELIEF] <= 0.0 {
        hold_relief(&mut information);
        score[RELIEF] = 0.0;
    }
    for j in 0..PARAMETERS {
        information[(j, j)] *= 1.0 + 1e-6;
        information[(j, j)] += 1e-9;
    }
    information.cholesky().map(|c| c.solve(&score))
}

fn sums(ground: &Ground, sights: &[Sight], inliers: &[bool]) -> Sums {
    let axes = Axes::of(ground);
    let mut sums = Sums { cost: 0.0, score: Parameters::zeros(), information: Information::zeros() };
    for (sight, _) in sights.iter().zip(inliers).filter(|(_, inlier)| **inlier) {
        let Some(evidence) = ground.evidence(&axes, sight) else { continue };
        sums.cost += evidence.cost;
        sums.score += evidence.score();
        sums.information += evidence.information();
    }
    sums
}

fn cost(ground: &Ground, sights: &[Sight], inliers: &[bool]) -> f64 {
    let homography = ground.homography();
    let of = |s: &Sight| ground.misfit(&homography, s).map_or(1e9, |(d2, ln_det)| d2 + ln_det);
    sights.iter().zip(inliers).filter(|(_, inlier)| **inlier).map(|(s, _)| of(s)).sum()
}
