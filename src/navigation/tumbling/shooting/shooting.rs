//! The shooting estimator: the free-body motion that fits all pairs best.

use super::fit::{Fit, FitProblem};
use super::held::{HeldDirections, SHORT_ARC_PRIOR, simplest_motion, weak_directions};
use super::initial::initial_guesses;
use crate::navigation::tumbling::bounds::{INERTIA_UNIT, UndeterminedDirection};
use crate::navigation::tumbling::config::TumblingConfig;
use crate::navigation::tumbling::error::TumblingError;
use crate::navigation::tumbling::pair::RotationPair;
use crate::stats::{SQUARED_NORMAL_MEDIAN_3D, upper_median};
use nalgebra::SMatrix;

/// Image intervals that the first arc holds at least.
const LEAST_INTERVALS: usize = 20;

/// Misfit in standard deviations beyond which the pairs and the motion have nothing to do with each other.
const HOPELESS_SIGMA: f64 = 30.0;

const MOST_REJECTION_ROUNDS: usize = 6;

/// A finished fit and what it says of itself.
pub struct ShootingFit {
    pub fit: Fit,
    /// Covariance of (initial rate, ratios); directions that are not determined have the spread of a guess.
    pub covariance: SMatrix<f64, 8, 8>,
    pub undetermined: Vec<UndeterminedDirection>,
    pub residual_rms_sigma: f64,
    pub pairs_used: usize,
}

/// Fits pairs over a growing arc of the images at `times_s` (the first one 0).
///
/// # Errors
/// Too few pairs in the first arc, or no free body that fits them.
pub fn shoot(pairs: &[RotationPair], times_s: &[f64], config: &TumblingConfig) -> Result<ShootingFit, TumblingError> {
    let weak_prior = SMatrix::identity() * SHORT_ARC_PRIOR;
    let mut arc_s = config.first_arc_s;
    let mut frames = frames_within(times_s, arc_s).max(LEAST_INTERVALS + 1).min(times_s.len());
    let mut fit = fit_first_arc(pairs, &times_s[..frames], &weak_prior, config)?;
    while frames < times_s.len() {
        arc_s = (arc_s * config.growth).max(times_s[frames]);
        frames = frames_within(times_s, arc_s).min(times_s.len());
        let arc_pairs = pairs_within(pairs, frames);
        fit = fit_robustly(&arc_pairs, &times_s[..frames], &weak_prior, &fit, config);
    }
    finish(pairs, times_s, fit, config)
}

fn frames_within(times_s: &[f64], arc_s: f64) -> usize {
    times_s.partition_point(|&t| t <= arc_s)
}

fn pairs_within(pairs: &[RotationPair], frames: usize) -> Vec<RotationPair> {
    pairs.iter().filter(|p| p.to < frames).cloned().collect()
}

fn fit_first_arc(
    pairs: &[RotationPair],
    times_s: &[f64],
    prior: &SMatrix<f64, 5, 5>,
    config: &TumblingConfig,
) -> Result<Fit, TumblingError> {
    let arc_pairs = pairs_within(pairs, times_s.len());
    if arc_pairs.len() < 3 {
        return Err(TumblingError::TooFewPairs { usable: arc_pairs.len(), given: pairs.len(), needed: 3 });
    }
    let guesses = initial_guesses(&arc_pairs, times_s);
    let fits = guesses.iter().filter_map(|guess| {
        let start = FitProblem { pairs: &arc_pairs, times_s, huber: f64::INFINITY, prior }.start(guess)?;
        Some(fit_robustly(&arc_pairs, times_s, prior, &start, config))
    });
    // Fits of different robust widths are compared by their median misfit.
    fits.map(|fit| (typical(misfits(&arc_pairs, &fit)), fit))
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, fit)| fit)
        .ok_or(TumblingError::TooFewPairs { usable: arc_pairs.len(), given: pairs.len(), needed: times_s.len() - 1 })
}

/// Fits with a robust width that follows the size of the misfits down.
fn fit_robustly(
    pairs: &[RotationPair],
    times_s: &[f64],
    prior: &SMatrix<f64, 5, 5>,
    start: &Fit,
    config: &TumblingConfig,
) -> Fit {
    let mut fit =
        FitProblem { pairs, times_s, huber: f64::INFINITY, prior }.start(&start.guess).unwrap_or(start.clone());
    let mut scale = f64::INFINITY;
    for _ in 0..4 {
        let next_scale = robust_scale(misfits(pairs, &fit));
        if next_scale > 0.7 * scale {
            break;
        }
        scale = next_scale;
        let problem = FitProblem { pairs, times_s, huber: config.huber_sigma * scale, prior };
        fit = problem.solve(&fit.guess).unwrap_or(fit);
    }
    fit
}

fn misfits(pairs: &[RotationPair], fit: &Fit) -> Vec<f64> {
    pairs.iter().map(|p| (p.whitening * p.misfit_rad(&fit.points)).norm()).collect()
}

fn typical(mut values: Vec<f64>) -> f64 {
    upper_median(&mut values).expect("an arc without pairs is refused at first")
}

/// How many times larger than their covariances the misfits are, at least 1.
fn robust_scale(misfits_sigma: Vec<f64>) -> f64 {
    (typical(misfits_sigma) / SQUARED_NORMAL_MEDIAN_3D.sqrt()).max(1.0)
}

/// The last fit: bad pairs left out, undetermined directions held, the rest free.
fn finish(
    pairs: &[RotationPair],
    times_s: &[f64],
    rough: Fit,
    config: &TumblingConfig,
) -> Result<ShootingFit, TumblingError> {
    refuse_hopeless(pairs, &rough)?;
    let mut used = agreeing_pairs(pairs, &rough, config);
    let mut fit = simplest_motion(&used, times_s, rough);
    let mut held = HeldDirections::of(&fit, config);
    for _ in 0..MOST_REJECTION_ROUNDS {
        let problem = FitProblem { pairs: &used, times_s, huber: f64::INFINITY, prior: &held.prior() };
        fit = problem.solve(&fit.guess).unwrap_or(fit);
        let (next_used, next_held) = (agreeing_pairs(pairs, &fit, config), HeldDirections::of(&fit, config));
        let more_held = next_held.count() > held.count();
        let settled = next_used.len() == used.len() && !more_held;
        used = next_used;
        if more_held {
            held = next_held;
        }
        if settled {
            break;
        }
    }
    summarize(fit, &used, held, config).ok_or(TumblingError::TooFewPairs {
        usable: used.len(),
        given: pairs.len(),
        needed: LEAST_INTERVALS,
    })
}

impl ShootingFit {
    /// Whether every direction of the ratios has at least this information (units |ω| and 0.3).
    pub fn determines_inertia(&self, least_information: f64) -> bool {
        weak_directions(&self.fit, least_information).is_empty()
    }
}

fn refuse_hopeless(pairs: &[RotationPair], fit: &Fit) -> Result<(), TumblingError> {
    let misfit_sigma = typical(misfits(pairs, fit));
    if misfit_sigma <= HOPELESS_SIGMA {
        return Ok(());
    }
    let misfit_rad = typical(pairs.iter().map(|p| p.misfit_rad(&fit.points).norm()).collect());
    Err(TumblingError::NoConsistentMotion { misfit_deg: misfit_rad.to_degrees(), misfit_sigma })
}

fn agreeing_pairs(pairs: &[RotationPair], fit: &Fit, config: &TumblingConfig) -> Vec<RotationPair> {
    let sizes = misfits(pairs, fit);
    let gate = config.reject_sigma * robust_scale(sizes.clone());
    pairs.iter().zip(sizes).filter(|(_, size)| *size <= gate).map(|(pair, _)| pair.clone()).collect()
}

fn summarize(fit: Fit, used: &[RotationPair], held: HeldDirections, config: &TumblingConfig) -> Option<ShootingFit> {
    let squares: f64 = misfits(used, &fit).iter().map(|s| s * s).sum();
    let freedom = (3 * used.len()).checked_sub(8).filter(|&f| f > 0)? as f64;
    let variance_factor = squares / freedom;
    let guess = SMatrix::identity() / INERTIA_UNIT.powi(2);
    let mut covariance = held_covariance(&fit, &held.prior()).or_else(|| held_covariance(&fit, &guess))?;
    // Six standard deviations of a χ² mean: a well-stated covariance passes.
    if config.scale_covariance && variance_factor > 1.0 + 6.0 * (2.0 / freedom).sqrt() {
        covariance *= variance_factor;
    }
    let residual_rms_sigma = variance_factor.sqrt();
    Some(ShootingFit { covariance, undetermined: held.undetermined, residual_rms_sigma, pairs_used: used.len(), fit })
}

/// Covariance of (initial rate, ratios) from the pairs and what is held.
fn held_covariance(fit: &Fit, prior: &SMatrix<f64, 5, 5>) -> Option<SMatrix<f64, 8, 8>> {
    let mut information = fit.information;
    let mut ratios = information.fixed_view_mut::<5, 5>(3, 3);
    ratios += prior;
    information.cholesky().map(|c| c.inverse())
}
