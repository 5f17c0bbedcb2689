//! A linearised measurement: what was measured less what was predicted.

use crate::stats::symmetric;
use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OMatrix, SMatrix, SVector};
use smallvec::{SmallVec, smallvec};

/// Error states of up to so many components are corrected without allocation.
pub(super) const INLINE: usize = 128;

/// An error state whose size is known only at run time.
pub type ErrorState = SmallVec<[f64; INLINE]>;

/// `H P`, a vector of `M` components for each column of P.
pub(super) type Rows<const M: usize> = SmallVec<[SVector<f64, M>; INLINE]>;

/// A Jacobian of `M` rows in blocks of `W` columns, each with the column where it starts; all other columns are 0, and
/// cost nothing. A dense Jacobian is one block.
pub type Blocks<const M: usize, const W: usize> = SmallVec<[(usize, SMatrix<f64, M, W>); 4]>;

/// Residual `z - h(x)` of `M` components, its Jacobian by the error state, and the covariance of the measurement noise.
#[derive(Debug, Clone, PartialEq)]
pub struct Innovation<const M: usize, const W: usize> {
    /// Measured less predicted.
    pub residual: SVector<f64, M>,
    /// Derivative of the prediction by the error state.
    pub jacobian: Blocks<M, W>,
    /// Covariance of the measurement noise.
    pub noise: SMatrix<f64, M, M>,
}

impl<const M: usize, const W: usize> Innovation<M, W> {
    /// An innovation whose Jacobian is one block: the error state's first `W` components, or all of them.
    pub fn dense(residual: SVector<f64, M>, jacobian: SMatrix<f64, M, W>, noise: SMatrix<f64, M, M>) -> Self {
        Innovation { residual, jacobian: smallvec![(0, jacobian)], noise }
    }

    /// Normalised innovation squared under a prior covariance; `None` if the innovation covariance `H P Hᵀ + R` is not
    /// positive definite.
    pub fn normalized_squared<D: Dim>(&self, prior: &OMatrix<f64, D, D>) -> Option<f64>
    where
        DefaultAllocator: Allocator<D, D>,
    {
        let rows = self.times_covariance(prior.as_slice(), prior.nrows());
        let inverse = positive_inverse(&self.covariance(&rows))?;
        Some(self.residual.dot(&(inverse * self.residual)))
    }

    /// `H x` for a column `x` of the error state.
    pub(super) fn times(&self, column: &[f64]) -> SVector<f64, M> {
        let part = |start: usize| SVector::<f64, W>::from_column_slice(&column[start..start + W]);
        self.jacobian.iter().map(|(start, block)| block * part(*start)).sum()
    }

    /// `H P` for a symmetric `P` of `n` columns.
    pub(super) fn times_covariance(&self, p: &[f64], n: usize) -> Rows<M> {
        p.chunks_exact(n).map(|column| self.times(column)).collect()
    }

    /// `H P Hᵀ + R` from `H P`.
    pub(super) fn covariance(&self, rows: &[SVector<f64, M>]) -> SMatrix<f64, M, M> {
        let mut s = self.noise;
        for (start, block) in &self.jacobian {
            s += SMatrix::<f64, M, W>::from_fn(|i, k| rows[start + k][i]) * block.transpose();
        }
        symmetric(&s)
    }
}

/// Inverse of a symmetric matrix, in closed form where it is 2×2; `None` if it is not positive definite.
pub(super) fn positive_inverse<const M: usize>(s: &SMatrix<f64, M, M>) -> Option<SMatrix<f64, M, M>> {
    if M != 2 {
        return s.cholesky().map(|cholesky| cholesky.inverse());
    }
    let is_positive = s[(0, 0)] > 0.0 && s[(0, 0)] * s[(1, 1)] - s[(1, 0)] * s[(0, 1)] > 0.0;
    if is_positive { s.try_inverse() } else { None }
}
