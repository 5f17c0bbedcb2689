//! Whether errors are as large as the covariance says.

use super::metrics::{Metrics, Series, Verdict};
use crate::stats::ConsistencyBounds;
use nalgebra::{SMatrix, SVector};

/// Errors of one epoch, whitened by the estimator's covariance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NormalizedSample<const N: usize> {
    /// Time in s.
    pub t_s: f64,
    /// `L⁻¹ error` with `covariance = L Lᵀ`: independent with variance 1 if the estimator is consistent.
    pub whitened: SVector<f64, N>,
}

impl<const N: usize> NormalizedSample<N> {
    /// Whitens an error; `None` if the covariance is not positive definite.
    ///
    /// Row and column scaling by the standard deviations keeps units of very different size apart.
    pub fn new(t_s: f64, error: &SVector<f64, N>, covariance: &SMatrix<f64, N, N>) -> Option<Self> {
        let sigma = covariance.diagonal().map(f64::sqrt);
        if sigma.iter().any(|s| s.is_nan() || *s <= 0.0) {
            return None;
        }
        let correlation = SMatrix::<f64, N, N>::from_fn(|i, j| covariance[(i, j)] / (sigma[i] * sigma[j]));
        let root = correlation.cholesky()?.l();
        let whitened = root.solve_lower_triangular(&error.component_div(&sigma))?;
        whitened.iter().all(|v| v.is_finite()).then_some(NormalizedSample { t_s, whitened })
    }

    /// Normalised error squared, divided by its degrees of freedom.
    pub fn normalized(&self) -> f64 {
        self.whitened.norm_squared() / N as f64
    }
}

/// Number of independent samples in a series of correlated ones, for the mean of their squares:
/// `n / (1 + 2 Σ (1 - k/n) ρ_k²)` with ρ_k the autocorrelation at lag k, summed to its first value under 0.1.
///
/// Errors of one run of a filter persist, so its epochs are worth far fewer runs than their number (Bar-Shalom, Li,
/// Kirubarajan 2001, section 5.4.2, where the same law serves the whiteness test).
pub fn effective_samples<const N: usize>(samples: &[NormalizedSample<N>]) -> f64 {
    let stride = samples.len().div_ceil(2000).max(1);
    let kept: Vec<_> = samples.iter().step_by(stride).map(|s| s.whitened).collect();
    let n = kept.len() as f64;
    let power = kept.iter().map(|w| w.norm_squared()).sum::<f64>() / n;
    if kept.is_empty() || power == 0.0 {
        return n;
    }
    let mut sum = 0.0;
    for lag in 1..kept.len() {
        let products: f64 = kept.iter().zip(&kept[lag..]).map(|(a, b)| a.dot(b)).sum();
        let correlation = products / (kept.len() - lag) as f64 / power;
        if correlation < 0.1 {
            break;
        }
        sum += (1.0 - lag as f64 / n) * correlation.min(1.0).powi(2);
    }
    (n / (1.0 + 2.0 * sum)).max(1.0)
}

/// Consistency of one run.
#[derive(Debug, Clone, PartialEq)]
pub struct Consistency {
    /// Mean of the normalised errors squared, divided by the degrees of freedom: 1 is perfect.
    pub mean: f64,
    /// 95 % bounds of the mean for the effective number of independent samples.
    pub bounds: ConsistencyBounds,
    /// Effective number of independent samples.
    pub effective_samples: f64,
    /// 95 % bounds of one epoch.
    pub epoch_bounds: ConsistencyBounds,
    /// Share of the epochs within their bounds: .95 is perfect.
    pub share_within: f64,
}

impl Consistency {
    /// Judges a run; `None` without samples.
    pub fn of<const N: usize>(samples: &[NormalizedSample<N>]) -> Option<Self> {
        if samples.is_empty() {
            return None;
        }
        let count = samples.len() as f64;
        let epoch_bounds = ConsistencyBounds::of_mean(N, 1, 0.95);
        let effective_samples = effective_samples(samples);
        Some(Consistency {
            mean: samples.iter().map(NormalizedSample::normalized).sum::<f64>() / count,
            bounds: ConsistencyBounds::of_mean(N, effective_samples as usize, 0.95),
            effective_samples,
            epoch_bounds,
            share_within: samples.iter().filter(|s| epoch_bounds.contains(s.normalized())).count() as f64 / count,
        })
    }
}

impl Metrics {
    /// Adds the consistency of a run of `epochs` epochs: figures, curve and diagnosis.
    pub(super) fn add_consistency<const N: usize>(&mut self, samples: &[NormalizedSample<N>], epochs: usize) {
        let Some(consistency) = Consistency::of(samples) else {
            return self.note("No epoch has a positive definite covariance, so consistency cannot be judged.");
        };
        if samples.len() < epochs {
            let left_out = epochs - samples.len();
            self.note(format!("{left_out} of {epochs} epochs have no positive definite covariance and no NEES."));
        }
        self.add_bounded("nees_per_dof_mean", consistency.mean, "1", Some(consistency.bounds));
        self.add("nees_effective_samples", consistency.effective_samples, "1");
        self.add("nees_share_within_95", consistency.share_within, "1");
        let diagnosis = consistency.bounds.diagnosis(consistency.mean);
        self.verdicts.push(Verdict {
            name: "consistent".into(),
            holds: consistency.bounds.contains(consistency.mean),
            reason: format!(
                "mean NEES/{N} {:.2} against [{:.2}, {:.2}] for {:.0} independent samples: {diagnosis}",
                consistency.mean, consistency.bounds.lower, consistency.bounds.upper, consistency.effective_samples
            ),
        });
        self.series.push(Series {
            name: "nees_per_dof".into(),
            unit: "1".into(),
            t_s: samples.iter().map(|s| s.t_s).collect(),
            values: samples.iter().map(NormalizedSample::normalized).collect(),
            sigma: vec![],
            bound: Some(consistency.epoch_bounds),
        });
    }
}
