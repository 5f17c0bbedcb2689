//! Fisher information of an arc of measurements and the Cramér–Rao bound.

use crate::stats::symmetric;
use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// Information about `n` unknowns, in the inverse squares of their units.
#[derive(Debug, Clone, PartialEq)]
pub struct FisherInformation {
    matrix: DMatrix<f64>,
}

/// A direction of the unknowns that the measurements say too little about.
#[derive(Debug, Clone, PartialEq)]
pub struct WeakDirection {
    /// Unit vector over the unknowns (in their scaled units).
    pub direction: DVector<f64>,
    /// Information along it: the inverse of a variance in the scaled units.
    pub information: f64,
}

impl FisherInformation {
    /// Nothing known about `unknowns` quantities.
    pub fn zero(unknowns: usize) -> Self {
        FisherInformation { matrix: DMatrix::zeros(unknowns, unknowns) }
    }

    /// Information given as a symmetric matrix.
    pub fn from_matrix(matrix: DMatrix<f64>) -> Self {
        FisherInformation { matrix: symmetric(&matrix) }
    }

    /// Adds one Gaussian measurement by the derivative (measurements × unknowns) of its whitened residual (unit
    /// covariance).
    pub fn add_whitened(&mut self, jacobian: &DMatrix<f64>) {
        self.matrix += jacobian.transpose() * jacobian;
    }

    /// The matrix.
    pub fn matrix(&self) -> &DMatrix<f64> {
        &self.matrix
    }

    /// The same information with unknown `i` counted in multiples of `units[i]`.
    pub fn in_units(&self, units: &[f64]) -> Self {
        let scale = DMatrix::from_diagonal(&DVector::from_column_slice(units));
        FisherInformation { matrix: &scale * &self.matrix * &scale }
    }

    /// Information about the unknowns from number `first` on when those before it are unknown too (Schur complement);
    /// `None` if the ones before cannot be determined at all.
    pub fn marginal_from(&self, first: usize) -> Option<Self> {
        let n = self.matrix.nrows();
        let nuisance = self.matrix.view((0, 0), (first, first)).into_owned();
        let cross = self.matrix.view((0, first), (first, n - first)).into_owned();
        let wanted = self.matrix.view((first, first), (n - first, n - first)).into_owned();
        let explained = nuisance.cholesky()?.solve(&cross);
        Some(Self::from_matrix(wanted - cross.transpose() * explained))
    }

    /// Eigenvalues, smallest first.
    pub fn eigenvalues(&self) -> Vec<f64> {
        let mut values: Vec<f64> = self.matrix.clone().symmetric_eigenvalues().iter().copied().collect();
        values.sort_by(f64::total_cmp);
        values
    }

    /// Directions with less information than `threshold`, weakest first.
    pub fn weak_directions(&self, threshold: f64) -> Vec<WeakDirection> {
        let eigen = SymmetricEigen::new(self.matrix.clone());
        let mut weak: Vec<WeakDirection> = (0..eigen.eigenvalues.len())
            .filter(|&i| eigen.eigenvalues[i] < threshold)
            .map(|i| WeakDirection {
                direction: eigen.eigenvectors.column(i).into_owned(),
                information: eigen.eigenvalues[i],
            })
            .collect();
        weak.sort_by(|a, b| a.information.total_cmp(&b.information));
        weak
    }

    /// The Cramér–Rao bound: no unbiased estimator has a smaller covariance. `None` if a direction is unknown.
    pub fn cramer_rao_bound(&self) -> Option<DMatrix<f64>> {
        self.matrix.clone().cholesky().map(|c| c.inverse())
    }
}
