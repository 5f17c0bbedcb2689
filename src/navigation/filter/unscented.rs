//! The unscented Kalman filter on any manifold: points around the estimate go through the exact model, and what comes out
//! tells mean and covariance.
//!
//! Source: Julier and Uhlmann, "Unscented filtering and nonlinear estimation" (2004); on manifolds as Brossard, Barrau,
//! Bonnabel, "A code for unscented Kalman filtering on manifolds" (2020).

use super::root::covariance_root;
use super::{Corrected, Gate, Innovation, Measurement, correction};
use crate::geometry::Manifold;
use crate::stats::Estimate;
use nalgebra::{SMatrix, SVector};

/// Most passes for a mean on a manifold; each squares what is left.
const MEAN_PASSES: usize = 10;

/// Where the sigma points lie and what they weigh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SigmaPoints {
    /// Spread α: the points lie α √(n + κ) standard deviations out (default 1).
    pub alpha: f64,
    /// Prior knowledge of the fourth moment β (default 2, a Gaussian's).
    pub beta: f64,
    /// Second spread κ (default 0).
    pub kappa: f64,
}

impl Default for SigmaPoints {
    fn default() -> Self {
        SigmaPoints { alpha: 1.0, beta: 2.0, kappa: 0.0 }
    }
}

/// Weights of the points of an error state of `n` components.
struct Weights {
    /// How many standard deviations out the points lie.
    reach: f64,
    center_of_mean: f64,
    center_of_covariance: f64,
    other: f64,
}

impl SigmaPoints {
    fn weights(&self, n: usize) -> Weights {
        let spread = self.alpha.powi(2) * (n as f64 + self.kappa);
        let center_of_mean = 1.0 - n as f64 / spread;
        Weights {
            reach: spread.sqrt(),
            center_of_mean,
            center_of_covariance: center_of_mean + 1.0 - self.alpha.powi(2) + self.beta,
            other: 0.5 / spread,
        }
    }
}

/// What a function makes of an estimate.
#[derive(Debug, Clone, PartialEq)]
pub struct Transformed<Y, const N: usize, const M: usize> {
    /// Mean of the values.
    pub mean: Y,
    /// Covariance of the values about it.
    pub covariance: SMatrix<f64, M, M>,
    /// Covariance of the state's error with the values.
    pub cross_covariance: SMatrix<f64, N, M>,
    /// Derivative of the mean, by statistical linearisation, by the error in units of the covariance's root.
    by_root: SMatrix<f64, M, N>,
}

/// Mean and covariance of `function` over an estimate, by 2n + 1 points; `None` if the covariance is not positive
/// semidefinite.
pub fn unscented_transform<S, Y, const N: usize, const M: usize>(
    estimate: &Estimate<S, N>,
    function: impl Fn(&S) -> Y,
    points: &SigmaPoints,
) -> Option<Transformed<Y, N, M>>
where
    S: Manifold<N>,
    Y: Manifold<M>,
{
    let (weights, root) = (points.weights(N), covariance_root(&estimate.covariance)?);
    let at = |d: SVector<f64, N>| function(&estimate.state.plus(&d));
    let center = at(SVector::zeros());
    let pairs: [[Y; 2]; N] = std::array::from_fn(|k| {
        let out = root.column(k) * weights.reach;
        [at(out), at(-out)]
    });
    let mean = mean_of(&center, &pairs, &weights);
    let off_center = center.minus(&mean);
    let mut covariance = off_center * off_center.transpose() * weights.center_of_covariance;
    let mut by_root = SMatrix::<f64, M, N>::zeros();
    for (k, [ahead, behind]) in pairs.iter().enumerate() {
        let (ahead, behind) = (ahead.minus(&mean), behind.minus(&mean));
        covariance += (ahead * ahead.transpose() + behind * behind.transpose()) * weights.other;
        by_root.set_column(k, &((ahead - behind) * (weights.other * weights.reach)));
    }
    Some(Transformed { mean, covariance, cross_covariance: root * by_root.transpose(), by_root })
}

/// The point from which the weighted differences to all others sum to 0.
fn mean_of<Y: Manifold<M>, const N: usize, const M: usize>(center: &Y, pairs: &[[Y; 2]; N], weights: &Weights) -> Y {
    let mut mean = center.plus(&SVector::zeros());
    for _ in 0..MEAN_PASSES {
        let mut shift = center.minus(&mean) * weights.center_of_mean;
        let mut spread = 0.0;
        for value in pairs.iter().flatten() {
            let off = value.minus(&mean);
            spread += off.norm_squared();
            shift += off * weights.other;
        }
        mean = mean.plus(&shift);
        if shift.norm_squared() <= 1e-24 * spread {
            break;
        }
    }
    mean
}

/// Estimate after `motion`, with process noise in the tangent space of the moved state; `None` if the covariance is not
/// positive semidefinite.
pub fn unscented_predict<S: Manifold<N>, const N: usize>(
    estimate: &Estimate<S, N>,
    motion: impl Fn(&S) -> S,
    process_noise: &SMatrix<f64, N, N>,
    points: &SigmaPoints,
) -> Option<Estimate<S, N>> {
    let moved: Transformed<S, N, N> = unscented_transform(estimate, motion, points)?;
    Some(Estimate { state: moved.mean, covariance: moved.covariance + process_noise }.symmetrized())
}

/// How an unscented filter corrects.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct UnscentedOptions {
    /// Innovation gate; without one every measurement is used.
    pub gate: Option<Gate>,
    /// The sigma points.
    pub points: SigmaPoints,
}

/// Estimate after a measurement that `model` predicts. `None` if the covariance is not positive semidefinite or that of
/// the innovation not positive definite.
pub fn unscented_correct<S, Y, const N: usize, const M: usize>(
    estimate: &Estimate<S, N>,
    measurement: &Measurement<Y, M>,
    model: impl Fn(&S) -> Y,
    options: &UnscentedOptions,
) -> Option<Corrected<S, N>>
where
    S: Manifold<N> + Clone,
    Y: Manifold<M>,
{
    let predicted = unscented_transform(estimate, model, &options.points)?;
    // In units of the root the prior covariance is the identity, and what the linearisation leaves out is noise.
    let unexplained = predicted.covariance - predicted.by_root * predicted.by_root.transpose();
    let residual = measurement.value.minus(&predicted.mean);
    let innovation = Innovation::dense(residual, predicted.by_root, measurement.noise + unexplained);
    let unit = SMatrix::<f64, N, N>::identity();
    let normalized_innovation_squared = innovation.normalized_squared(&unit)?;
    if options.gate.is_some_and(|gate| !gate.passes(normalized_innovation_squared, M)) {
        return Some(Corrected { estimate: estimate.clone(), normalized_innovation_squared, used: false });
    }
    let correction = correction(unit, &[innovation])?;
    let root = covariance_root(&estimate.covariance)?;
    let shift = root * SVector::<f64, N>::from_column_slice(&correction.shift);
    let estimate = recentred(&estimate.state, &shift, &(root * covariance_root(&correction.covariance)?));
    Some(Corrected { estimate, normalized_innovation_squared, used: true })
}

/// The estimate moved by `shift`, its covariance (given by a root) carried from the tangent space of the state before to
/// that of the state after.
fn recentred<S: Manifold<N>, const N: usize>(
    before: &S,
    shift: &SVector<f64, N>,
    root: &SMatrix<f64, N, N>,
) -> Estimate<S, N> {
    let state = before.plus(shift);
    let mut carried = SMatrix::<f64, N, N>::zeros();
    for (k, out) in root.column_iter().enumerate() {
        let (ahead, behind) = (before.plus(&(shift + out)), before.plus(&(shift - out)));
        carried.set_column(k, &((ahead.minus(&state) - behind.minus(&state)) * 0.5));
    }
    Estimate { state, covariance: carried * carried.transpose() }.symmetrized()
}
