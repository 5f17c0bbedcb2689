//! An extended Kalman filter on any manifold: give it a motion, or a model of a measurement, and it finds the
//! derivatives.

use super::innovation::Innovation;
use super::{Gate, QuadraticMoments, iterated_correction};
use crate::geometry::{Manifold, central_difference};
use crate::stats::Estimate;
use nalgebra::{SMatrix, SVector};

/// Half-width of a first difference, in standard deviations: wide enough to keep digits, and small against the width over
/// which a linearisation has to hold anyway.
const FIRST_STEP: f64 = 1e-3;
/// Half-width of a second difference, in standard deviations.
const SECOND_STEP: f64 = 0.05;

/// A measured value with the covariance of its noise, both in the tangent space of the measurement.
#[derive(Debug, Clone, PartialEq)]
pub struct Measurement<Y, const M: usize> {
    /// The measured value.
    pub value: Y,
    /// Covariance of the measurement noise.
    pub noise: SMatrix<f64, M, M>,
}

/// How an estimate is corrected; by default once, by whatever is measured.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CorrectionOptions {
    /// Innovation gate; without one every measurement is used.
    pub gate: Option<Gate>,
    /// Gauss–Newton steps; 0 and 1 are the extended Kalman filter.
    pub iterations: usize,
    /// Whether the prediction counts the curvature of the model: its mean is moved and its covariance grows.
    pub second_order: bool,
}

/// An estimate after a measurement.
#[derive(Debug, Clone, PartialEq)]
pub struct Corrected<S, const N: usize> {
    /// The estimate; the prior one if the measurement was gated.
    pub estimate: Estimate<S, N>,
    /// Normalised innovation squared at the prior estimate.
    pub normalized_innovation_squared: f64,
    /// Whether the measurement was used; otherwise it was gated.
    pub used: bool,
}

/// Estimate after `motion`, with process noise in the tangent space of the moved state.
pub fn predict<S: Manifold<N>, const N: usize>(
    estimate: &Estimate<S, N>,
    motion: impl Fn(&S) -> S,
    process_noise: &SMatrix<f64, N, N>,
) -> Estimate<S, N> {
    let f: SMatrix<f64, N, N> = derivative(estimate, &SVector::zeros(), &motion);
    let covariance = f * estimate.covariance * f.transpose() + process_noise;
    Estimate { state: motion(&estimate.state), covariance }.symmetrized()
}

/// Estimate after a measurement that `model` predicts, its derivatives by differences. `None` if the innovation covariance
/// is not positive definite.
pub fn correct<S, Y, const N: usize, const M: usize>(
    estimate: &Estimate<S, N>,
    measurement: &Measurement<Y, M>,
    model: impl Fn(&S) -> Y,
    options: &CorrectionOptions,
) -> Option<Corrected<S, N>>
where
    S: Manifold<N> + Clone,
    Y: Manifold<M>,
{
    let bend = match options.second_order {
        true => QuadraticMoments::of_model(estimate, &model, SECOND_STEP)?,
        false => QuadraticMoments { mean: SVector::zeros(), covariance: SMatrix::zeros() },
    };
    let linearize = |shift: &SVector<f64, N>| {
        let predicted = model(&estimate.state.plus(shift));
        let jacobian: SMatrix<f64, M, N> = derivative(estimate, shift, &model);
        Innovation::dense(
            measurement.value.minus(&predicted) - bend.mean,
            jacobian,
            measurement.noise + bend.covariance,
        )
    };
    correct_linearized(estimate, linearize, options)
}

/// Estimate after a measurement whose derivatives are known: `linearize` gives the innovation at the estimate moved by an
/// error state, with the Jacobian by that error state. What its curvature adds belongs in its noise
/// ([`QuadraticMoments`]); the option for it is not used here. `None` if the innovation covariance is not positive
/// definite.
pub fn correct_linearized<S, const N: usize, const M: usize, const W: usize>(
    estimate: &Estimate<S, N>,
    linearize: impl Fn(&SVector<f64, N>) -> Innovation<M, W>,
    options: &CorrectionOptions,
) -> Option<Corrected<S, N>>
where
    S: Manifold<N> + Clone,
{
    let normalized_innovation_squared = linearize(&SVector::zeros()).normalized_squared(&estimate.covariance)?;
    if options.gate.is_some_and(|gate| !gate.passes(normalized_innovation_squared, M)) {
        return Some(Corrected { estimate: estimate.clone(), normalized_innovation_squared, used: false });
    }
    let at = |shift: &[f64]| [linearize(&SVector::from_column_slice(shift))];
    let correction = iterated_correction(&estimate.covariance, options.iterations, at)?;
    let state = estimate.state.plus(&SVector::from_column_slice(&correction.shift));
    let estimate = Estimate { state, covariance: correction.covariance };
    Some(Corrected { estimate, normalized_innovation_squared, used: true })
}

/// Derivative (`M`×`N`) of `function` by an error state at `shift` from the estimate, by differences over a small part of
/// each standard deviation; 0 by what is known exactly, whose derivative has nothing to carry.
fn derivative<S, Y, const N: usize, const M: usize>(
    estimate: &Estimate<S, N>,
    shift: &SVector<f64, N>,
    function: impl Fn(&S) -> Y,
) -> SMatrix<f64, M, N>
where
    S: Manifold<N>,
    Y: Manifold<M>,
{
    let sigma = estimate.sigma();
    let in_sigmas = |d: &SVector<f64, N>| function(&estimate.state.plus(&(shift + d.component_mul(&sigma))));
    let by_sigmas: SMatrix<f64, M, N> = central_difference(in_sigmas, &SVector::<f64, N>::zeros(), FIRST_STEP);
    let inverse = sigma.map(|s| if s > 0.0 { 1.0 / s } else { 0.0 });
    by_sigmas * SMatrix::from_diagonal(&inverse)
}
