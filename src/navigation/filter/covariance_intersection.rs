//! Covariance intersection: estimates of one state fused although nobody knows how their errors are correlated.
//!
//! Source: Julier and Uhlmann, "A non-divergent estimation algorithm in the presence of unknown correlations" (1997);
//! weights by traces: Niehsen, "Information fusion based on fast covariance intersection filtering" (2002).

use crate::geometry::Manifold;
use crate::stats::Estimate;
use nalgebra::{SMatrix, SVector};
use smallvec::SmallVec;

/// Most steps towards the weights of the least determinant.
const WEIGHT_STEPS: usize = 200;
/// Most passes for a mean on a manifold.
const MEAN_PASSES: usize = 10;

/// How the weights of the estimates, which sum to 1, are chosen; the result is conservative for any.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum IntersectionWeights {
    /// In proportion to the inverse of each trace: closed form. The traces mix the units of the state's components.
    #[default]
    InverseTrace,
    /// Those of the least determinant of the fused covariance, whatever the units.
    LeastDeterminant,
}

type Matrices<const N: usize> = SmallVec<[SMatrix<f64, N, N>; 8]>;
type Shares = SmallVec<[f64; 8]>;

/// One estimate from several: `P⁻¹ = Σ w_j P_j⁻¹`, and the state from which the weighted differences to all others sum
/// to 0. Fusing an estimate with itself changes nothing. `None` if there are no estimates or a covariance is not positive
/// definite.
pub fn covariance_intersection<S: Manifold<N>, const N: usize>(
    estimates: &[Estimate<S, N>],
    weights: IntersectionWeights,
) -> Option<Estimate<S, N>> {
    let inverses: Matrices<N> = estimates.iter().map(|e| positive_inverse(&e.covariance)).collect::<Option<_>>()?;
    let shares = match weights {
        IntersectionWeights::InverseTrace => normalized(estimates.iter().map(|e| 1.0 / e.covariance.trace()).collect()),
        IntersectionWeights::LeastDeterminant => least_determinant(estimates, &inverses)?,
    };
    let covariance = positive_inverse(&weighted_sum(&inverses, &shares))?;
    let mut state = estimates.first()?.state.plus(&SVector::zeros());
    for _ in 0..MEAN_PASSES {
        let each = estimates.iter().zip(&inverses).zip(&shares);
        let pull: SVector<f64, N> = each.map(|((e, inverse), share)| inverse * e.state.minus(&state) * *share).sum();
        let shift = covariance * pull;
        state = state.plus(&shift);
        // In standard deviations of the result.
        if shift.dot(&pull) < 1e-24 {
            break;
        }
    }
    Some(Estimate { state, covariance }.symmetrized())
}

/// Weights of the least determinant by w_j ← w_j (tr(P P_j⁻¹) / n)^1.5, normalised: at the optimum of the convex problem
/// every factor is 1, or its weight 0.
fn least_determinant<S, const N: usize>(estimates: &[Estimate<S, N>], inverses: &Matrices<N>) -> Option<Shares> {
    let mut shares = Shares::from_elem(1.0 / estimates.len() as f64, estimates.len());
    for _ in 0..WEIGHT_STEPS {
        let fused = positive_inverse(&weighted_sum(inverses, &shares))?;
        let factor = |inverse: &SMatrix<f64, N, N>| (fused.dot(inverse) / N as f64).powf(1.5);
        let next = normalized(shares.iter().zip(inverses).map(|(share, inverse)| share * factor(inverse)).collect());
        let moved = next.iter().zip(&shares).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        shares = next;
        if moved < 1e-12 {
            break;
        }
    }
    Some(shares)
}

fn normalized(mut shares: Shares) -> Shares {
    let total: f64 = shares.iter().sum();
    shares.iter_mut().for_each(|share| *share /= total);
    shares
}

fn weighted_sum<const N: usize>(inverses: &Matrices<N>, shares: &Shares) -> SMatrix<f64, N, N> {
    inverses.iter().zip(shares).map(|(inverse, share)| inverse * *share).sum()
}

fn positive_inverse<const N: usize>(covariance: &SMatrix<f64, N, N>) -> Option<SMatrix<f64, N, N>> {
    covariance.cholesky().map(|cholesky| cholesky.inverse())
}
