//! Errors that vary smoothly over the image, as unknowns of their own.
//!
//! The looks of a surface change with the view and the light, and they change alike all over the image or a good part
//! of it. Patches and corners follow. No number of matches averages such an error out, and a motion is easily bent to it:
//! at low orders, a change of rotation looks the same. So the error of a match, in units of its noise, is a polynomial of
//! its place with normal coefficients, besides white noise. The polynomial is eliminated from the normal equations of the
//! motion (Schur complement), which leaves the motion to what a smooth error cannot imitate.
//!
//! The coefficients' variance, as a share of the noise's, is the most likely one of the pair (restricted likelihood,
//! Patterson and Thompson 1971), held near what images rendered with known motion show. Residuals tell of the smooth
//! error only what a motion cannot imitate, and of that the likeliest share is on the small side. The motion itself is best
//! weighted with a small one; its covariance counts with the whole one.

use super::cluster_robust::{cells, covariance_of_rotation};
use super::correlated_modes::{COEFFICIENTS, Places};
use super::elimination::Sums;
use crate::vision::pair::normalized_match::NormalizedMatch;
use crate::vision::pair::residual::{PairModel, residual};
use crate::vision::pair::robust_fit::{Loss, PairFit, observed_information};
use nalgebra::{Matrix3, SMatrix, SVector};

/// The share of the noise's variance that the coefficients have, at least: nothing is perfectly white.
const LEAST_SHARE: f64 = 1e-9;

/// A motion refined with the smooth error as an unknown.
pub struct CorrelatedFit<M> {
    pub model: M,
    /// Covariance (rad²) of its rotation.
    pub rotation_covariance_rad2: Matrix3<f64>,
}

/// How large a smooth error is.
#[derive(Debug, Clone, Copy)]
pub struct Size {
    /// The expected variance of its coefficients, as a share of the noise's.
    pub share: f64,
    /// Their true variance over the likeliest one.
    pub over_likeliest: f64,
}

/// Refines a fit on the matches that agree with it, its smooth error eliminated; `None` where that leaves it undetermined.
pub fn refine<const N: usize, M: PairModel<N>>(
    fit: &PairFit<N, M>,
    normalized: &[NormalizedMatch],
    size: Size,
) -> Option<CorrelatedFit<M>> {
    let inside = fit.agreeing(normalized);
    let places = Places::of(&inside);
    let mut sums = Sums::of(&fit.model, &inside, (&places, fit.scale));
    let share = sums.likeliest_share(size.share.max(LEAST_SHARE));
    let mut model = fit.model;
    for _ in 0..2 {
        model = model.moved(&sums.eliminated(share)?.step()?);
        sums = Sums::of(&model, &inside, (&places, fit.scale));
    }
    let left = sums.eliminated(share)?;
    // The product of Jacobians takes noise for parallax; by how much, the second derivative knows.
    let observed = observed_information(&model, &inside, Loss::Truncated(f64::INFINITY)) / fit.scale.powi(2);
    let bias = observed.cholesky()?.inverse() - sums.motion.cholesky()?.inverse();
    let covariance = sums.covariance(&left, share * size.over_likeliest)? + bias;
    covariance.cholesky()?;
    let scores = left.scores(&model, &inside, (&places, fit.scale));
    let rotation_covariance_rad2 = covariance_of_rotation(&covariance, &scores, &cells(&inside))?;
    Some(CorrelatedFit { model, rotation_covariance_rad2 })
}

/// What a pair says about a motion as if all errors were white: the information, the gradient, and how that gradient moves
/// with the coefficients of the smooth error.
pub struct White<const N: usize> {
    pub information: SMatrix<f64, N, N>,
    pub gradient: SVector<f64, N>,
    pub by_correlated_error: SMatrix<f64, N, COEFFICIENTS>,
}

impl<const N: usize> White<N> {
    /// Over the matches within 3σ, `scale` being the noise over the nominal one.
    pub fn of<M: PairModel<N>>(model: &M, normalized: &[NormalizedMatch], scale: f64) -> Self {
        let matrix = model.matrix().0;
        let near = |s: &&NormalizedMatch| residual(M::RELATION, &matrix, s).norm() < 3.0 * scale;
        let inside: Vec<NormalizedMatch> = normalized.iter().filter(near).copied().collect();
        let sums = Sums::of(model, &inside, (&Places::of(&inside), scale));
        White { information: sums.motion, gradient: sums.motion_gradient, by_correlated_error: sums.mixed }
    }
}
