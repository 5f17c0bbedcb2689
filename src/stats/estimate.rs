//! A state with its covariance.

use super::symmetric::symmetric;
use crate::geometry::Manifold;
use nalgebra::{SMatrix, SVector};

/// An estimated state and the covariance (`N`×`N`) of its error in the state's tangent space.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate<S, const N: usize> {
    /// The estimated state.
    pub state: S,
    /// Covariance of `truth.minus(state)`.
    pub covariance: SMatrix<f64, N, N>,
}

impl<S: Manifold<N>, const N: usize> Estimate<S, N> {
    /// Estimate from independent standard deviations, one a tangent component.
    pub fn from_sigma(state: S, sigma: &SVector<f64, N>) -> Self {
        Estimate { state, covariance: SMatrix::from_diagonal(&sigma.component_mul(sigma)) }
    }

    /// Standard deviations, one a tangent component.
    pub fn sigma(&self) -> SVector<f64, N> {
        self.covariance.diagonal().map(|variance| variance.max(0.0).sqrt())
    }

    /// The covariance made exactly symmetric.
    pub fn symmetrized(mut self) -> Self {
        self.covariance = symmetric(&self.covariance);
        self
    }
}
