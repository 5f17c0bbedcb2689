//! An extended Kalman filter on any manifold, with numerical Jacobians.

use crate::geometry::{Manifold, central_difference};
use crate::stats::Estimate;
use nalgebra::{SMatrix, SVector};

/// A measured value with the covariance of its noise, both in the tangent space of the measurement.
#[derive(Debug, Clone, PartialEq)]
pub struct Measurement<Y, const M: usize> {
    /// The measured value.
    pub value: Y,
    /// Covariance of the measurement noise.
    pub noise: SMatrix<f64, M, M>,
}

/// Estimate after `motion`, with process noise in the tangent space of the moved state. `step` is the half-width of the
/// numerical derivative, in the unit of each error component.
pub fn predict<S: Manifold<N>, const N: usize>(
    estimate: &Estimate<S, N>,
    motion: impl Fn(&S) -> S,
    process_noise: &SMatrix<f64, N, N>,
    step: f64,
) -> Estimate<S, N> {
    let f: SMatrix<f64, N, N> = central_difference(&motion, &estimate.state, step);
    let covariance = f * estimate.covariance * f.transpose() + process_noise;
    Estimate { state: motion(&estimate.state), covariance }.symmetrized()
}

/// Estimate after a measurement, and the normalised innovation squared; covariance in Joseph's form. `None` if the
/// innovation covariance is not positive definite. `step` as in [`predict`].
pub fn correct<S: Manifold<N>, Y: Manifold<M>, const N: usize, const M: usize>(
    estimate: &Estimate<S, N>,
    measurement: &Measurement<Y, M>,
    model: impl Fn(&S) -> Y,
    step: f64,
) -> Option<(Estimate<S, N>, f64)> {
    let h: SMatrix<f64, M, N> = central_difference(&model, &estimate.state, step);
    let residual: SVector<f64, M> = measurement.value.minus(&model(&estimate.state));
    let p = estimate.covariance;
    let cholesky = (h * p * h.transpose() + measurement.noise).cholesky()?;
    let k = cholesky.solve(&(h * p)).transpose();
    let left = SMatrix::<f64, N, N>::identity() - k * h;
    let covariance = left * p * left.transpose() + k * measurement.noise * k.transpose();
    let corrected = Estimate { state: estimate.state.plus(&(k * residual)), covariance }.symmetrized();
    Some((corrected, residual.dot(&cholesky.solve(&residual))))
}
