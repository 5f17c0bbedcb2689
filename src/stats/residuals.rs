//! Plain least squares of residuals with a Jacobian.

use super::least_squares::{LeastSquares, NormalEquations};
use crate::geometry::Manifold;
use nalgebra::{Const, SMatrix, SVector};
use std::marker::PhantomData;

/// Half the sum of `M` squared residuals over a state with `N` unknowns, for [`minimize`](super::minimize).
#[derive(Debug, Clone, Copy)]
pub struct Residuals<S, F, const N: usize, const M: usize> {
    function: F,
    state: PhantomData<S>,
}

impl<S, F, const N: usize, const M: usize> Residuals<S, F, N, M>
where
    F: Fn(&S) -> (SVector<f64, M>, SMatrix<f64, M, N>),
{
    /// Of the whitened residuals at a state and their derivative by its tangent vector.
    pub fn new(function: F) -> Self {
        Residuals { function, state: PhantomData }
    }
}

impl<S, F, const N: usize, const M: usize> LeastSquares for Residuals<S, F, N, M>
where
    S: Manifold<N>,
    F: Fn(&S) -> (SVector<f64, M>, SMatrix<f64, M, N>),
{
    type Size = Const<N>;
    type State = S;

    fn normal_equations(&self, state: &S) -> NormalEquations<Const<N>> {
        let (residuals, jacobian) = (self.function)(state);
        NormalEquations {
            information: jacobian.tr_mul(&jacobian),
            right_side: -jacobian.tr_mul(&residuals),
            cost: 0.5 * residuals.norm_squared(),
        }
    }

    fn moved(&self, state: &S, step: &SVector<f64, N>) -> Option<S> {
        Some(state.plus(step))
    }
}
