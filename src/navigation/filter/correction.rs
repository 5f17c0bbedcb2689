//! The Kalman correction for error states of any size.

use super::innovation::Innovation;
use nalgebra::{DMatrix, DVector};

/// What a measurement does to an estimate.
#[derive(Debug, Clone, PartialEq)]
pub struct Correction {
    /// Error state to retract onto the prior estimate.
    pub shift: DVector<f64>,
    /// Covariance after the measurement, exactly symmetric.
    pub covariance: DMatrix<f64>,
    /// Normalised innovation squared at the prior estimate.
    pub normalized_innovation_squared: f64,
}

/// Correction by one innovation, covariance in Joseph's form; `None` if the innovation covariance is not positive
/// definite.
pub fn correction(prior: &DMatrix<f64>, innovation: &Innovation) -> Option<Correction> {
    iterated_correction(prior, 1, |_| innovation.clone())
}

/// Iterated correction: Gauss–Newton on the posterior, `iterations` steps (1 is the extended Kalman filter).
///
/// `linearize` gives the innovation at the prior estimate moved by an error state. Source: Bell and Cathey, "The
/// iterated Kalman filter update as a Gauss–Newton method" (1993). `None` if an innovation covariance is not positive
/// definite.
pub fn iterated_correction(
    prior: &DMatrix<f64>,
    iterations: usize,
    linearize: impl Fn(&DVector<f64>) -> Innovation,
) -> Option<Correction> {
    let mut shift = DVector::zeros(prior.nrows());
    let mut innovation = linearize(&shift);
    let normalized_innovation_squared = innovation.normalized_squared(prior)?;
    let mut k = gain(prior, &innovation)?;
    for iteration in 0..iterations.max(1) {
        if iteration > 0 {
            innovation = linearize(&shift);
            k = gain(prior, &innovation)?;
        }
        shift = &k * (&innovation.residual + &innovation.jacobian * &shift);
    }
    let covariance = joseph(prior, &k, &innovation);
    Some(Correction { shift, covariance, normalized_innovation_squared })
}

/// Kalman gain `P Hᵀ (H P Hᵀ + R)⁻¹`.
fn gain(prior: &DMatrix<f64>, innovation: &Innovation) -> Option<DMatrix<f64>> {
    let cholesky = innovation.covariance(prior).cholesky()?;
    Some(cholesky.solve(&(&innovation.jacobian * prior)).transpose())
}

/// `(I - K H) P (I - K H)ᵀ + K R Kᵀ`, made exactly symmetric.
fn joseph(prior: &DMatrix<f64>, k: &DMatrix<f64>, innovation: &Innovation) -> DMatrix<f64> {
    let n = prior.nrows();
    let left = DMatrix::identity(n, n) - k * &innovation.jacobian;
    let p = &left * prior * left.transpose() + k * &innovation.noise * k.transpose();
    (&p + p.transpose()) * 0.5
}
