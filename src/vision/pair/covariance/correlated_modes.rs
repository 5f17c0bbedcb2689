//! The polynomials of which a smooth error is made.

use crate::vision::pair::normalized_match::NormalizedMatch;
use nalgebra::{Matrix2, Matrix3, SVector, Vector2};

/// Polynomials up to the third order.
pub(super) const MODES: usize = 10;
/// The first modes, up to the second order; the others have half the variance.
const LOW_MODES: usize = 6;
/// Coefficients of the error, two components a mode.
pub const COEFFICIENTS: usize = 2 * MODES;

/// Variance of a coefficient over that of the noise.
pub(super) fn variance(coefficient: usize, share: f64) -> f64 {
    if coefficient % MODES < LOW_MODES { share } else { 0.5 * share }
}

/// Where the matches lie in the first image.
pub(super) struct Places {
    center: Vector2<f64>,
    spread: f64,
}

impl Places {
    pub(super) fn of(normalized: &[NormalizedMatch]) -> Self {
        let count = normalized.len().max(1) as f64;
        let center = normalized.iter().map(|s| s.from).sum::<Vector2<f64>>() / count;
        let square = normalized.iter().map(|s| (s.from - center).norm_squared()).sum::<f64>() / (2.0 * count);
        Places { center, spread: square.sqrt().max(1e-9) }
    }

    /// The polynomials at a match, each of a mean square near 1 over an even image.
    pub(super) fn modes(&self, matched: &NormalizedMatch) -> [f64; MODES] {
        const H: f64 = std::f64::consts::FRAC_1_SQRT_2;
        let p = (matched.from - self.center) / self.spread;
        let (x2, y2) = (p.x * p.x, p.y * p.y);
        let second = [p.x * p.y, H * (x2 - 1.0), H * (y2 - 1.0)];
        let third = [p.x * (x2 - 1.8), p.y * (y2 - 1.8), p.x * (y2 - 1.0), p.y * (x2 - 1.0)].map(|m| 0.5 * m);
        let [a, b, c] = second;
        let [d, e, f, g] = third;
        [1.0, p.x, p.y, a, b, c, d, e, f, g]
    }

    /// Derivative of a match's whitened residual by the coefficients.
    pub(super) fn by_coefficients(
        &self,
        matrix: &Matrix3<f64>,
        matched: &NormalizedMatch,
    ) -> SVector<f64, COEFFICIENTS> {
        let (left, right) = (matrix.tr_mul(&matched.second_ray()).xy(), (matrix * matched.first_ray()).xy());
        let variance = left.dot(&(matched.from_covariance * left)) + right.dot(&(matched.to_covariance * right));
        let one = matched.to_covariance.cholesky().map_or_else(Matrix2::zeros, |c| c.l());
        // Both pixels err: the error of one against the other has twice the variance of either.
        let by_error = one.tr_mul(&right) * std::f64::consts::SQRT_2 / variance.max(1e-300).sqrt();
        let modes = self.modes(matched);
        SVector::from_fn(|i, _| by_error[i / MODES] * modes[i % MODES])
    }
}
