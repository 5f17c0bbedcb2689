//! Settings of the tumbling estimators.

use super::error::TumblingError;
use serde::{Deserialize, Serialize};

/// Which estimator.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Estimator {
    /// The extended Kalman filter of Deng et al. (2024) on the chained attitude: the baseline.
    Paper,
    /// Shooting over a first arc, then a filter with stored attitudes, one picture at a time.
    Realtime,
    /// Batch fit of the free-body motion to all pairs: the best of the three.
    #[default]
    Shooting,
}

/// How the paper's filter steps its state and covariance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PaperIntegration {
    /// One Euler step a picture, `Φ = I + C ΔT`, as printed (equations 34 and 36).
    #[default]
    Euler,
    /// Runge–Kutta sub-steps and the exact transition matrix.
    RungeKutta,
}

/// Settings of the paper's filter.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PaperConfig {
    /// Diagonal of Q, per step, on (δq_v, δω in rad/s, δl); the paper's 0.001.
    pub process_variance: f64,
    /// Diagonal of R on δq_v (half angles, rad²); the paper's 0.001.
    pub measurement_variance: f64,
    /// Diagonal of P₀; not given in the paper, 1 here.
    pub initial_variance: f64,
    /// Initial rate in °/s; the paper's (0.5, 0.23, 0.35), whose unit it does not give.
    pub initial_rate_deg_s: [f64; 3],
    /// Initial inertia ratios; the paper's (0.7, 0.7, 0, 0, 0).
    pub initial_inertia: [f64; 5],
    /// How to step.
    pub integration: PaperIntegration,
}

impl Default for PaperConfig {
    fn default() -> Self {
        PaperConfig {
            process_variance: 0.001,
            measurement_variance: 0.001,
            initial_variance: 1.0,
            initial_rate_deg_s: [0.5, 0.23, 0.35],
            initial_inertia: [0.7, 0.7, 0.0, 0.0, 0.0],
            integration: PaperIntegration::Euler,
        }
    }
}

/// Settings of [`estimate`](super::estimate).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TumblingConfig {
    /// Which estimator; `shooting`.
    pub estimator: Estimator,
    /// Length in s of the first arc that shooting fits; 40. At least 20 picture intervals are taken in any case.
    pub first_arc_s: f64,
    /// Factor by which the arc grows from fit to fit; 1.6 (a fit of a long arc at once fails).
    pub growth: f64,
    /// Misfit in standard deviations (3-dimensional norm) from which a pair's pull is bounded, while the arc grows; 4.
    pub huber_sigma: f64,
    /// Misfit in standard deviations (3-dimensional norm) from which a pair is left out at the end; 5.
    pub reject_sigma: f64,
    /// Whether covariances grow with the square of the residuals' excess where residuals are larger than the pairs'
    /// covariances explain; true.
    pub scale_covariance: bool,
    /// Information (units |ω| and 0.3) below which a direction of the inertia counts as not determined; 10.
    pub least_information: f64,
    /// Length in s of the arc that starts the real-time estimator; 60.
    pub realtime_start_s: f64,
    /// Stored attitudes that the real-time estimator keeps; 24.
    pub realtime_clones: usize,
    /// Settings of the paper's filter.
    pub paper: PaperConfig,
}

impl Default for TumblingConfig {
    fn default() -> Self {
        TumblingConfig {
            estimator: Estimator::Shooting,
            first_arc_s: 40.0,
            growth: 1.6,
            huber_sigma: 4.0,
            reject_sigma: 5.0,
            scale_covariance: true,
            least_information: 10.0,
            realtime_start_s: 60.0,
            realtime_clones: 24,
            paper: PaperConfig::default(),
        }
    }
}

impl TumblingConfig {
    /// Checks every range.
    ///
    /// # Errors
    /// [`TumblingError::BadConfig`] names the setting.
    pub fn validate(&self) -> Result<(), TumblingError> {
        let above = [
            ("first-arc-s", self.first_arc_s, 0.0, "give a positive number of seconds, such as 40"),
            ("growth", self.growth, 1.0, "give a factor above 1, such as 1.6"),
            ("huber-sigma", self.huber_sigma, 0.0, "give a positive number, such as 4"),
            ("reject-sigma", self.reject_sigma, 1.0, "give a number above 1, such as 5"),
            ("least-information", self.least_information, 0.0, "give a positive number, such as 10"),
            ("realtime-start-s", self.realtime_start_s, 0.0, "give a positive number of seconds, such as 60"),
            ("realtime-clones", self.realtime_clones as f64, 1.0, "keep at least 2 attitudes, such as 24"),
            ("paper.process-variance", self.paper.process_variance, 0.0, "give a positive variance, such as 0.001"),
            (
                "paper.measurement-variance",
                self.paper.measurement_variance,
                0.0,
                "give a positive variance, such as 0.001",
            ),
            ("paper.initial-variance", self.paper.initial_variance, 0.0, "give a positive variance, such as 1"),
        ];
        for (key, value, floor, cure) in above {
            if !(value > floor && value.is_finite()) {
                return Err(TumblingError::BadConfig { key, value, cure });
            }
        }
        let rates = self.paper.initial_rate_deg_s.map(|v| ("paper.initial-rate-deg-s", v));
        let ratios = self.paper.initial_inertia.map(|v| ("paper.initial-inertia", v));
        for (key, value) in rates.into_iter().chain(ratios) {
            if !value.is_finite() {
                return Err(TumblingError::BadConfig { key, value, cure: "give finite numbers" });
            }
        }
        Ok(())
    }
}
