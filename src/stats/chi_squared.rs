//! Consistency of an estimator: normalised errors squared (NEES, NIS) against χ² bounds.
//!
//! Source: Bar-Shalom, Li, Kirubarajan, "Estimation with Applications to Tracking and Navigation" (2001), section 5.4.

use nalgebra::{SMatrix, SVector};
use serde::{Deserialize, Serialize};
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// `errorᵀ covariance⁻¹ error`; `None` if the covariance is not positive definite.
pub fn normalized_error_squared<const N: usize>(
    error: &SVector<f64, N>,
    covariance: &SMatrix<f64, N, N>,
) -> Option<f64> {
    let cholesky = covariance.cholesky()?;
    Some(error.dot(&cholesky.solve(error)))
}

/// Two-sided bounds on the mean of normalised errors squared, each already divided by its degrees of freedom.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ConsistencyBounds {
    /// Lower bound, 1 being perfect.
    pub lower: f64,
    /// Upper bound, 1 being perfect.
    pub upper: f64,
}

impl ConsistencyBounds {
    /// Bounds for the mean of `samples` independent normalised errors of `degrees_of_freedom` each, that a consistent
    /// estimator leaves with probability `1 - confidence`.
    pub fn of_mean(degrees_of_freedom: usize, samples: usize, confidence: f64) -> Self {
        let total = (degrees_of_freedom * samples).max(1) as f64;
        let tail = 0.5 * (1.0 - confidence);
        let chi = ChiSquared::new(total).expect("a positive number of degrees of freedom");
        ConsistencyBounds { lower: chi.inverse_cdf(tail) / total, upper: chi.inverse_cdf(1.0 - tail) / total }
    }

    /// The value that one normalised error of `degrees_of_freedom` exceeds with probability `1 - confidence` (a gate).
    pub fn gate(degrees_of_freedom: usize, confidence: f64) -> f64 {
        if degrees_of_freedom == 2 {
            return -2.0 * (1.0 - confidence).ln();
        }
        let chi = ChiSquared::new(degrees_of_freedom.max(1) as f64).expect("a positive number of degrees of freedom");
        chi.inverse_cdf(confidence)
    }

    /// Whether a normalised mean lies inside.
    pub fn contains(&self, normalized_mean: f64) -> bool {
        (self.lower..=self.upper).contains(&normalized_mean)
    }

    /// What a normalised mean says of the estimator, in one sentence.
    pub fn diagnosis(&self, normalized_mean: f64) -> &'static str {
        if normalized_mean.is_nan() {
            "undetermined: there is no normalised error to judge"
        } else if normalized_mean > self.upper {
            "overconfident: errors are larger than the covariance says"
        } else if normalized_mean < self.lower {
            "pessimistic: errors are smaller than the covariance says"
        } else {
            "consistent: errors agree with the covariance"
        }
    }
}
