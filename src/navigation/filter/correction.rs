//! The Kalman correction: of a covariance of fixed size or of one that grows, by measurements with dense or sparse
//! Jacobians.

use super::innovation::{ErrorState, Innovation, Rows, positive_inverse};
use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OMatrix, SMatrix, SVector};

/// What measurements do to an estimate.
#[derive(Debug, Clone, PartialEq)]
pub struct Correction<D: Dim>
where
    DefaultAllocator: Allocator<D, D>,
{
    /// Error state to retract onto the prior estimate.
    pub shift: ErrorState,
    /// Covariance after the measurements, exactly symmetric.
    pub covariance: OMatrix<f64, D, D>,
    /// Joint normalised innovation squared at the prior estimate.
    pub normalized_innovation_squared: f64,
}

/// Correction by independent innovations that are linearised at the prior estimate: one after the other in Joseph's
/// form, which is the same as all at once. The covariance is corrected in place; error states of up to 128 components
/// cost no allocation. `None` if an innovation covariance is not positive definite.
pub fn correction<D: Dim, const M: usize, const W: usize>(
    prior: OMatrix<f64, D, D>,
    innovations: &[Innovation<M, W>],
) -> Option<Correction<D>>
where
    DefaultAllocator: Allocator<D, D>,
{
    let mut covariance = prior;
    let n = covariance.nrows();
    let mut shift = ErrorState::from_elem(0.0, n);
    let mut normalized_innovation_squared = 0.0;
    for innovation in innovations {
        let rows = innovation.times_covariance(covariance.as_slice(), n);
        let inverse = positive_inverse(&innovation.covariance(&rows))?;
        let residual = innovation.residual - innovation.times(&shift);
        let weighted = inverse * residual;
        normalized_innovation_squared += residual.dot(&weighted);
        for (component, row) in shift.iter_mut().zip(&rows) {
            *component += row.dot(&weighted);
        }
        joseph(covariance.as_mut_slice(), innovation, &rows, &inverse);
    }
    Some(Correction { shift, covariance, normalized_innovation_squared })
}

/// Iterated correction: Gauss–Newton on the posterior, `iterations` steps (1 is the extended Kalman filter).
///
/// `linearize` gives the innovations at the prior estimate moved by an error state, with their Jacobians by that error
/// state. Source: Bell and Cathey, "The iterated Kalman filter update as a Gauss–Newton method" (1993). `None` if an
/// innovation covariance is not positive definite.
pub fn iterated_correction<D: Dim, I, const M: usize, const W: usize>(
    prior: &OMatrix<f64, D, D>,
    iterations: usize,
    linearize: impl Fn(&[f64]) -> I,
) -> Option<Correction<D>>
where
    DefaultAllocator: Allocator<D, D>,
    I: AsMut<[Innovation<M, W>]>,
{
    let mut innovations = linearize(&ErrorState::from_elem(0.0, prior.nrows()));
    let mut latest = correction(prior.clone(), innovations.as_mut())?;
    let normalized_innovation_squared = latest.normalized_innovation_squared;
    for _ in 1..iterations {
        innovations = linearize(&latest.shift);
        for innovation in innovations.as_mut() {
            innovation.residual += innovation.times(&latest.shift);
        }
        latest = correction(prior.clone(), innovations.as_mut())?;
    }
    Some(Correction { normalized_innovation_squared, ..latest })
}

/// P ← (I - K H) P (I - K H)ᵀ + K R Kᵀ with K = P Hᵀ S⁻¹, in place; `rows` holds H P.
fn joseph<const M: usize, const W: usize>(
    p: &mut [f64],
    innovation: &Innovation<M, W>,
    rows: &[SVector<f64, M>],
    inverse: &SMatrix<f64, M, M>,
) {
    let n = rows.len();
    let gains: Rows<M> = rows.iter().map(|row| inverse * row).collect();
    // (I - K H) P, column by column.
    for (column, row) in p.chunks_exact_mut(n).zip(rows) {
        for (entry, gain) in column.iter_mut().zip(&gains) {
            *entry -= gain.dot(row);
        }
    }
    // What is left of H P after that, row by row: ((I - K H) P) Hᵀ - K R.
    let mut left = Rows::<M>::from_elem(SVector::zeros(), n);
    for (start, block) in &innovation.jacobian {
        for k in 0..W {
            let weight = block.column(k).into_owned();
            for (row, entry) in left.iter_mut().zip(&p[(start + k) * n..]) {
                *row += weight * *entry;
            }
        }
    }
    for (row, gain) in left.iter_mut().zip(&gains) {
        *row -= innovation.noise * gain;
    }
    for (column, gain) in p.chunks_exact_mut(n).zip(&gains) {
        for (entry, row) in column.iter_mut().zip(&left) {
            *entry -= row.dot(gain);
        }
    }
    make_symmetric(p, n);
}

fn make_symmetric(p: &mut [f64], n: usize) {
    for column in 0..n {
        for row in column + 1..n {
            let mean = 0.5 * (p[row + n * column] + p[column + n * row]);
            p[row + n * column] = mean;
            p[column + n * row] = mean;
        }
    }
}
