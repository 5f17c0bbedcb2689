//! What is asked of a pair, and its solution.

use super::config::RotationConfig;
use super::correspondence::MatchedPair;
use crate::observations::{PairStatus, RotationModel};
use nalgebra::{Matrix3, Unit, UnitQuaternion, Vector3};

/// What two images say about the motion between them.
#[derive(Debug, Clone, PartialEq)]
pub struct PairSolution {
    /// Rotation from the first camera's axes to the second's; identity where the status is not ok.
    pub camera_to_from_camera_from: UnitQuaternion<f64>,
    /// Covariance (rad²) of the error `d` in `true = exp(d) * estimated`, axes of the second camera; zero where the
    /// status is not ok.
    pub covariance_rad2: Matrix3<f64>,
    /// Direction of the translation in the second camera (`x_to = R x_from + t`), where there is one.
    pub direction_in_to: Option<Unit<Vector3<f64>>>,
    /// Normal of the dominant plane in the first camera, where the matches lie on one.
    pub normal_in_from: Option<Unit<Vector3<f64>>>,
    /// Which matches agree with the motion.
    pub inliers: Vec<bool>,
    /// Actual pixel noise over nominal pixel noise, as the residuals show it.
    pub noise_scale: f64,
    /// The model used.
    pub model: RotationModel,
    /// The outcome.
    pub status: PairStatus,
}

impl PairSolution {
    pub(in crate::vision) fn failed(status: PairStatus, matches: usize) -> Self {
        PairSolution {
            camera_to_from_camera_from: UnitQuaternion::identity(),
            covariance_rad2: Matrix3::zeros(),
            direction_in_to: None,
            normal_in_from: None,
            inliers: vec![false; matches],
            noise_scale: 1.0,
            model: RotationModel::None,
            status,
        }
    }

    /// Matches that agree.
    pub fn inlier_count(&self) -> usize {
        self.inliers.iter().filter(|i| **i).count()
    }
}

/// Matched pixels with their noise.
#[derive(Debug, Clone, Copy)]
pub struct PixelMatches<'a> {
    /// The pixels.
    pub pair: &'a MatchedPair,
    /// 1σ of each coordinate of each match in px (of either pixel; their mean where they differ).
    pub sigma_px: &'a [f64],
}

/// What else is known of a pair.
#[derive(Debug, Clone, Copy, Default)]
pub struct PairHints {
    /// Predicted rotation (from a gyroscope, say): a start, a judge between rival solutions, and a gate.
    pub camera_to_from_camera_from: Option<UnitQuaternion<f64>>,
    /// Normal of the ground in the first camera as the pair before found it: a judge between rival solutions only.
    pub normal_in_from: Option<Unit<Vector3<f64>>>,
}

pub(super) fn is_determined(covariance: &Matrix3<f64>, config: &RotationConfig) -> bool {
    let greatest = covariance.symmetric_eigenvalues().max();
    greatest.is_finite() && greatest.sqrt() < config.max_sigma_rad
}
