//! What the estimators hand back.

use super::bounds::{UndeterminedDirection, determined_elements};
use super::motion::{InertiaRatios, SpinState};
use nalgebra::{SMatrix, UnitQuaternion, Vector3};

/// The estimate at one image.
#[derive(Debug, Clone, PartialEq)]
pub struct TumblingEpoch {
    /// Time of the image in ns.
    pub t_ns: i64,
    /// Attitude (Hamilton); inertial axes are the camera's, asteroid axes the camera's at the first image.
    pub asteroid_from_inertial: UnitQuaternion<f64>,
    /// Angular rate in asteroid axes, rad/s.
    pub rate_in_asteroid_rad_s: Vector3<f64>,
    /// Covariance of `truth.minus(estimate)` of [`SpinState`]: (attitude error in inertial axes in rad, `truth = estimate
    /// * exp(d)`; rate error in asteroid axes in rad/s). The attitude block of the first image is zero: the attitude is
    ///   the identity there by definition.
    pub covariance: SMatrix<f64, 6, 6>,
    /// The inertia known at this epoch.
    pub inertia: InertiaKnowledge,
}

impl TumblingEpoch {
    /// Attitude and rate as one state.
    pub fn state(&self) -> SpinState {
        SpinState {
            asteroid_from_inertial: self.asteroid_from_inertial,
            rate_in_asteroid_rad_s: self.rate_in_asteroid_rad_s,
        }
    }
}

/// Inertia ratios (Lxx, Lyy, Lxy, Lxz, Lyz), Lzz = 1, as far as they are determined.
#[derive(Debug, Clone, PartialEq)]
pub struct InertiaKnowledge {
    /// Each element, `None` where the data do not determine it.
    pub elements: [Option<f64>; 5],
    /// 1σ of each element that is determined.
    pub sigma: [Option<f64>; 5],
}

impl InertiaKnowledge {
    pub(super) fn new(
        inertia: &InertiaRatios,
        covariance: &SMatrix<f64, 5, 5>,
        undetermined: &[UndeterminedDirection],
    ) -> Self {
        let known = determined_elements(undetermined);
        InertiaKnowledge {
            elements: std::array::from_fn(|i| known[i].then_some(inertia.0[i])),
            sigma: std::array::from_fn(|i| known[i].then(|| covariance[(i, i)].max(0.0).sqrt())),
        }
    }
}

/// The motion along the whole sequence.
#[derive(Debug, Clone, PartialEq)]
pub struct TumblingResult {
    /// One epoch an image.
    pub epochs: Vec<TumblingEpoch>,
    /// Inertia ratios (Lxx, Lyy, Lxy, Lxz, Lyz) at the end; `None` if any direction is not determined (single elements
    /// may still stand in the last epoch).
    pub inertia_ratios: Option<[f64; 5]>,
    /// 1σ of the ratios.
    pub inertia_sigma: Option<[f64; 5]>,
    /// Covariance of the ratios.
    pub inertia_covariance: Option<SMatrix<f64, 5, 5>>,
    /// Directions of the inertia that the images do not determine. The paper's filter cannot tell and leaves it empty.
    pub undetermined: Vec<UndeterminedDirection>,
    /// Root mean square of the used pairs' residuals over their standard deviations: 1 if the pairs' covariances hold.
    pub residual_rms_sigma: f64,
    /// Pairs that went in.
    pub pairs_used: usize,
    /// Pairs with the status ok that were left out because they contradict the motion or could not be used.
    pub pairs_rejected: usize,
}

/// How pairs fared.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct PairCount {
    pub used: usize,
    pub given: usize,
    pub residual_rms_sigma: f64,
}

impl TumblingResult {
    pub(super) fn new(
        epochs: Vec<TumblingEpoch>,
        inertia: &InertiaRatios,
        covariance: &SMatrix<f64, 5, 5>,
        undetermined: Vec<UndeterminedDirection>,
        pairs: PairCount,
    ) -> Self {
        let known = undetermined.is_empty();
        TumblingResult {
            epochs,
            inertia_ratios: known.then_some(inertia.0),
            inertia_sigma: known.then(|| covariance.diagonal().map(|v| v.max(0.0).sqrt()).into()),
            inertia_covariance: known.then_some(*covariance),
            undetermined,
            residual_rms_sigma: pairs.residual_rms_sigma,
            pairs_used: pairs.used,
            pairs_rejected: pairs.given - pairs.used,
        }
    }
}
