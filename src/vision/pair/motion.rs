//! The motion that a fitted ground stands for, its relief left free where it shows.

use super::covariance::{Size, refine};
use super::models::General;
use super::normalized_match::NormalizedMatch;
use super::plane::ReliefPlaneFit;
use crate::observations::RotationModel;
use crate::stats::upper_median;
use crate::vision::noise_model::PairNoise;
use nalgebra::{Matrix3, Unit, UnitQuaternion, Vector3};

/// Relief shows where the ratio of the variances of its parallax and of the noise, added up over the matches, exceeds this:
/// a decision between two models, no noise.
const SHOWING: f64 = 500.0;

/// A motion with its covariance.
pub(super) struct Motion {
    pub(super) rotation: UnitQuaternion<f64>,
    pub(super) covariance_rad2: Matrix3<f64>,
    pub(super) direction: Option<Unit<Vector3<f64>>>,
    pub(super) normal: Unit<Vector3<f64>>,
    pub(super) inliers: Vec<bool>,
    pub(super) noise_scale: f64,
    pub(super) model: RotationModel,
}

impl Motion {
    /// The motion of a ground; `None` where the matches do not determine it.
    ///
    /// Relief is not white noise about a plane: hills are smooth. Where its parallax shows, each point's depth is better
    /// left free, and what the plane would say is not missed. Where it does not show, depths left free would take noise
    /// for parallax.
    pub(super) fn of(fit: &ReliefPlaneFit, normalized: &[NormalizedMatch], noise: &PairNoise) -> Option<Motion> {
        let direction = Unit::try_new(fit.ground.translation, 1e-12);
        let free = direction.filter(|_| relief_over_noise(fit, normalized) > SHOWING);
        free.and_then(|direction| with_free_relief(fit, direction, (normalized, noise))).or_else(|| {
            Some(Motion {
                rotation: fit.ground.rotation,
                covariance_rad2: fit.rotation_covariance(normalized)?,
                direction,
                normal: fit.ground.normal,
                inliers: fit.inliers.clone(),
                noise_scale: fit.scale(),
                model: RotationModel::Homography,
            })
        })
    }
}

/// Median ratio of the variances of the relief's parallax and of the noise, times the matches.
fn relief_over_noise(fit: &ReliefPlaneFit, normalized: &[NormalizedMatch]) -> f64 {
    let (ground, homography) = (&fit.ground, fit.ground.homography());
    let ratio = |s: &NormalizedMatch| {
        let seen = ground.predict(&homography, s)?;
        let g = seen.by_relief;
        Some(g.dot(&(seen.nominal.try_inverse()? * g)) * ground.relief_variance / ground.noise_variance)
    };
    let mut ratios: Vec<f64> = fit.agreeing(normalized).iter().filter_map(ratio).collect();
    let count = ratios.len() as f64;
    upper_median(&mut ratios).unwrap_or(0.0) * count
}

/// The same motion refined on the epipolar constraint, over the matches that agree with the ground: what lies far along
/// an epipolar line has great leverage on it, and the ground knows how far relief goes.
fn with_free_relief(
    fit: &ReliefPlaneFit,
    direction: Unit<Vector3<f64>>,
    (normalized, noise): (&[NormalizedMatch], &PairNoise),
) -> Option<Motion> {
    const WIDEST_SIGMA: f64 = 4.0;
    let inside = fit.agreeing(normalized);
    let start = General { rotation: fit.ground.rotation, direction };
    let refined = super::robust_fit::fit(start, &inside, WIDEST_SIGMA * fit.scale());
    let mut flags = refined.inliers.iter();
    let inliers = fit.inliers.iter().map(|i| *i && *flags.next().unwrap_or(&false)).collect();
    let view = fit.ground.translation.norm_squared();
    let size = Size { share: noise.share(view), over_likeliest: noise.over_likeliest };
    let smoothed = refine(&refined, &inside, size)?;
    Some(Motion {
        rotation: smoothed.model.rotation,
        covariance_rad2: smoothed.rotation_covariance_rad2,
        direction: Some(smoothed.model.direction),
        normal: fit.ground.normal,
        inliers,
        noise_scale: refined.scale,
        model: RotationModel::Essential,
    })
}
