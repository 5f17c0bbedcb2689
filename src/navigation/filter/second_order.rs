//! What the curvature of a measurement adds to its prediction.

use super::root::covariance_root;
use crate::geometry::Manifold;
use crate::stats::Estimate;
use nalgebra::{SMatrix, SVector};

/// Mean and covariance of `M` quadratic forms ½ xᵀ A_i x of a Gaussian x of mean 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct QuadraticMoments<const M: usize> {
    /// ½ tr(A_i P).
    pub mean: SVector<f64, M>,
    /// ½ tr(A_i P A_j P).
    pub covariance: SMatrix<f64, M, M>,
}

impl<const M: usize> QuadraticMoments<M> {
    /// Moments by the symmetric matrices A_i and the covariance P of x. Source: Bar-Shalom, Li, Kirubarajan, "Estimation
    /// with Applications to Tracking and Navigation" (2001), section 10.3.2, the second-order filter.
    pub fn new<const N: usize>(hessians: &[SMatrix<f64, N, N>; M], covariance: &SMatrix<f64, N, N>) -> Self {
        let products = hessians.map(|hessian| hessian * covariance);
        let mut moments = QuadraticMoments { mean: SVector::zeros(), covariance: SMatrix::zeros() };
        for (i, product) in products.iter().enumerate() {
            let transposed = product.transpose();
            moments.mean[i] = 0.5 * product.trace();
            for (j, other) in products.iter().enumerate().take(i + 1) {
                moments.covariance[(i, j)] = 0.5 * other.dot(&transposed);
                moments.covariance[(j, i)] = moments.covariance[(i, j)];
            }
        }
        moments
    }

    /// Moments of the second order of `model` about an estimate, by differences over `step` standard deviations; `None`
    /// if the covariance is not positive semidefinite.
    pub(super) fn of_model<S, Y, const N: usize>(
        estimate: &Estimate<S, N>,
        model: impl Fn(&S) -> Y,
        step: f64,
    ) -> Option<Self>
    where
        S: Manifold<N>,
        Y: Manifold<M>,
    {
        // With x = L u the Hessians by u are Lᵀ A_i L, and u has unit covariance.
        let root = covariance_root(&estimate.covariance)? * step;
        let center = model(&estimate.state);
        let moved = |d: &SVector<f64, N>| model(&estimate.state.plus(d)).minus(&center);
        let mut hessians = [SMatrix::<f64, N, N>::zeros(); M];
        for k in 0..N {
            for l in 0..=k {
                let (sum, difference) = (root.column(k) + root.column(l), root.column(k) - root.column(l));
                let bend = moved(&sum) + moved(&-sum) - moved(&difference) - moved(&-difference);
                for (hessian, value) in hessians.iter_mut().zip(bend.iter()) {
                    hessian[(k, l)] = value / (4.0 * step * step);
                    hessian[(l, k)] = hessian[(k, l)];
                }
            }
        }
        Some(Self::new(&hessians, &SMatrix::identity()))
    }
}
