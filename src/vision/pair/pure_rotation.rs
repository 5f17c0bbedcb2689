//! Pairs between which the camera only turned, or rested.

use super::config::RotationConfig;
use super::models::{KnownPlane, Plane, Turn};
use super::normalized_match::NormalizedMatch;
use super::robust_fit::PairFit;
use super::solution::PairSolution;
use crate::geometry::so3;
use crate::observations::{PairStatus, RotationModel};
use nalgebra::{Matrix3, Unit, UnitQuaternion, Vector3};

/// A pure rotation: its covariance allows for an unseen translation over ground ahead; no rotation at all is no motion.
pub(super) fn judge_turn(
    turn: &PairFit<3, Turn>,
    normalized: &[NormalizedMatch],
    config: &RotationConfig,
) -> Result<PairSolution, PairStatus> {
    const CHI2_3_AT_999: f64 = 16.27;
    const STILL_PX_SIGMA: f64 = 0.15;
    let alone = turn.covariance.ok_or(PairStatus::Degenerate)?;
    let angle = so3::log(&turn.model.0);
    let surprise = alone.try_inverse().map_or(0.0, |information| angle.dot(&(information * angle)));
    let still = super::robust_fit::robust_scale::<3, _>(&Turn(UnitQuaternion::identity()), normalized, 1e6);
    if surprise < CHI2_3_AT_999 || still < STILL_PX_SIGMA {
        return Err(PairStatus::NoMotion);
    }
    let ahead = normalized.iter().map(|s| s.first_ray().normalize()).sum::<Vector3<f64>>();
    let plane = Plane { rotation: turn.model.0, translation: Vector3::zeros(), normal: Unit::new_normalize(ahead) };
    let loss = super::robust_fit::Loss::Truncated(3.45 * turn.scale);
    let normal = super::robust_fit::normal_equations(&KnownPlane(plane), normalized, loss);
    let covariance = normal.information.try_inverse().ok_or(PairStatus::Degenerate)? * turn.scale.powi(2);
    let covariance: Matrix3<f64> = covariance.fixed_view::<3, 3>(0, 0).into_owned();
    if !super::solution::is_determined(&covariance, config) {
        return Err(PairStatus::Degenerate);
    }
    Ok(PairSolution {
        camera_to_from_camera_from: turn.model.0,
        covariance_rad2: covariance,
        inliers: turn.inliers.clone(),
        noise_scale: turn.scale,
        model: RotationModel::Homography,
        status: PairStatus::Ok,
        ..PairSolution::failed(PairStatus::Ok, 0)
    })
}
