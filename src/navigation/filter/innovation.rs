//! A linearised measurement: what was measured less what was predicted.

use nalgebra::{DMatrix, DVector};

/// Residual `z - h(x)`, its Jacobian by the error state, and the covariance of the measurement noise.
#[derive(Debug, Clone, PartialEq)]
pub struct Innovation {
    /// Measured less predicted, `m` components.
    pub residual: DVector<f64>,
    /// Derivative of the prediction by the error state, `m`×`n`.
    pub jacobian: DMatrix<f64>,
    /// Covariance of the measurement noise, `m`×`m`.
    pub noise: DMatrix<f64>,
}

impl Innovation {
    /// Covariance of the residual under the prior covariance: `H P Hᵀ + R`.
    pub fn covariance(&self, prior: &DMatrix<f64>) -> DMatrix<f64> {
        &self.jacobian * prior * self.jacobian.transpose() + &self.noise
    }

    /// Normalised innovation squared; `None` if the innovation covariance is not positive definite.
    pub fn normalized_squared(&self, prior: &DMatrix<f64>) -> Option<f64> {
        let cholesky = self.covariance(prior).cholesky()?;
        Some(self.residual.dot(&cholesky.solve(&self.residual)))
    }

    /// Independent innovations of one error state, one below the other; `None` if there are none.
    pub fn stacked(parts: &[Innovation]) -> Option<Innovation> {
        let columns = parts.first()?.jacobian.ncols();
        let rows = parts.iter().map(|part| part.residual.len()).sum();
        let mut all = Innovation {
            residual: DVector::zeros(rows),
            jacobian: DMatrix::zeros(rows, columns),
            noise: DMatrix::zeros(rows, rows),
        };
        let mut row = 0;
        for part in parts {
            let m = part.residual.len();
            all.residual.rows_mut(row, m).copy_from(&part.residual);
            all.jacobian.rows_mut(row, m).copy_from(&part.jacobian);
            all.noise.view_mut((row, row), (m, m)).copy_from(&part.noise);
            row += m;
        }
        Some(all)
    }
}
