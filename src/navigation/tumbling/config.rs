//! Settings of the tumbling estimators.

use crate::settings::{OutOfRange, limits};
use serde::{Deserialize, Serialize};

/// Which estimator.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "settings", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Estimator {
    /// The extended Kalman filter of Deng et al. (2024) on the chained attitude: the baseline.
    Paper,
    /// Shooting over a first arc, then a filter with stored attitudes, one image at a time.
    Realtime,
    /// Batch fit of the free-body motion to all pairs: the best of the three.
    #[default]
    Shooting,
}

/// How the paper's filter steps its state and covariance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "settings", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum PaperIntegration {
    /// One Euler step an image, `Φ = I + C ΔT`, as printed (equations 34 and 36).
    #[default]
    Euler,
    /// Runge–Kutta sub-steps and the exact transition matrix.
    RungeKutta,
}

/// Settings of the paper's filter.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "settings", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct PaperConfig {
    /// Diagonal of Q, per step, on (δq_v, δω in rad/s, δl), above 0 (default 0.001, the paper's).
    pub process_variance: f64,
    /// Diagonal of R on δq_v (half angles, rad²), above 0 (default 0.001, the paper's).
    pub measurement_variance: f64,
    /// Diagonal of P₀, which the paper does not give, above 0 (default 1).
    pub initial_variance: f64,
    /// Initial rate in °/s (default 0.5, 0.23, 0.35, the paper's, whose unit it does not give).
    pub initial_rate_deg_s: [f64; 3],
    /// Initial inertia ratios (default 0.7, 0.7, 0, 0, 0, the paper's).
    pub initial_inertia: [f64; 5],
    /// How to step (default euler).
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
#[cfg_attr(feature = "settings", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct TumblingConfig {
    /// Which estimator (default shooting).
    pub estimator: Estimator,
    /// Length in s of the first arc that shooting fits, above 0 (default 40). At least 20 image intervals are taken in any case.
    pub first_arc_s: f64,
    /// Factor by which the arc grows from fit to fit, above 1 (default 1.6): a fit of a long arc at once fails.
    pub growth: f64,
    /// Misfit in standard deviations (3-dimensional norm) from which a pair's pull is bounded, while the arc grows,
    /// above 0 (default 4).
    pub huber_sigma: f64,
    /// Misfit in standard deviations (3-dimensional norm) from which a pair is left out at the end, above 1
    /// (default 5).
    pub reject_sigma: f64,
    /// Whether covariances grow with the square of the residuals' excess where residuals are larger than the pairs'
    /// covariances explain (default true).
    pub scale_covariance: bool,
    /// Information (units |ω| and 0.3) below which a direction of the inertia counts as not determined, above 0
    /// (default 10).
    pub least_information: f64,
    /// Length in s of the arc that starts the real-time estimator, above 0 (default 60).
    pub realtime_start_s: f64,
    /// Stored attitudes that the real-time estimator keeps, 2 or more (default 24).
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
    /// Names the key.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::positive("first_arc_s", self.first_arc_s)?;
        limits::above("growth", self.growth, 1.0)?;
        limits::positive("huber_sigma", self.huber_sigma)?;
        limits::above("reject_sigma", self.reject_sigma, 1.0)?;
        limits::positive("least_information", self.least_information)?;
        limits::positive("realtime_start_s", self.realtime_start_s)?;
        limits::count_from("realtime_clones", self.realtime_clones, 2)?;
        self.paper.validate().map_err(|e| e.under("paper"))
    }
}

impl PaperConfig {
    /// Checks every range.
    ///
    /// # Errors
    /// Names the key.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::positive("process_variance", self.process_variance)?;
        limits::positive("measurement_variance", self.measurement_variance)?;
        limits::positive("initial_variance", self.initial_variance)?;
        limits::finite("initial_rate_deg_s", &self.initial_rate_deg_s)?;
        limits::finite("initial_inertia", &self.initial_inertia)
    }
}
