//! Landmarks where no plane of the ground is known: the ray of a track's first sight is kept as two points of the state,
//! correlated in full, until a later sight meets it at an angle that tells the depth.
//!
//! The two points move, and are retracted, like any landmark, and a turn about the vertical moves them along with the
//! rest: what yaw must not learn from a ray it does not.

use super::initialize::{InitializationModel, augmented, bearing_noise};
use crate::navigation::landing::bearings::BearingObservation;
use crate::navigation::landing::error_state::{ATTITUDE, DescentEstimate, LandmarkRole, POSITION, UnknownLandmark};
use crate::stats::symmetric;
use nalgebra::{DMatrix, Matrix3, Vector3};

/// The estimate with the ray of a bearing, which is consumed: where the camera is, and the point at `reach_m` along it.
pub fn with_ray(
    estimate: &DescentEstimate,
    bearing: &BearingObservation,
    (slot, reach_m): (usize, f64),
    model: &InitializationModel,
) -> DescentEstimate {
    let (kind, camera_m) = (model.kind, model.camera_in_lander_m);
    let named = |position_in_site_m: Vector3<f64>, role: LandmarkRole| UnknownLandmark {
        role,
        ..UnknownLandmark::new(bearing.track_id, position_in_site_m, slot)
    };
    let origin = kind.point_of_arm(&estimate.state, &camera_m, 0.0);
    let arm_m = camera_m + bearing.direction_in_lander.into_inner() * reach_m;
    let point = kind.point_of_arm(&estimate.state, &arm_m, reach_m);
    let with_origin =
        augmented(estimate, named(origin.position_in_site_m, LandmarkRole::RayOrigin), &origin, &Matrix3::zeros());
    let landmark = named(point.position_in_site_m, LandmarkRole::RayPoint);
    augmented(&with_origin, landmark, &point, &bearing_noise(&point, bearing))
}

/// Where the ray that starts at landmark `index` and a bearing meet, if at `least_rad` or more; the ray gives way to the
/// landmark, and the bearing is consumed. The landmark stays on the ray, at the distance that the bearing names in the
/// plane of both; how far the two rays pass each other is not used. `None` where they meet too flat or behind.
pub fn triangulated(
    estimate: &DescentEstimate,
    index: usize,
    bearing: &BearingObservation,
    (least_rad, model): (f64, &InitializationModel),
) -> Option<DescentEstimate> {
    let (state, kind) = (&estimate.state, model.kind);
    let (origin, end) = (state.landmarks.get(index)?, state.landmarks.get(index + 1)?);
    if origin.role != LandmarkRole::RayOrigin {
        return None;
    }
    let z = bearing.direction_in_lander.into_inner();
    let ray = kind.in_error_axes(state, &(end.position_in_site_m - origin.position_in_site_m));
    let line = kind.lander_in_error_axes(state, &z);
    let aside = ray.cross(&line);
    if ray.angle(&line) < least_rad {
        return None;
    }
    // A normal of the second line in the plane of both: n · (a + λ e - x) = 0 on the line through the camera x.
    let n = line.cross(&aside).normalize();
    let camera_in_site_m = state.lander_in_site_m + state.lander_from_site.inverse() * model.camera_in_lander_m;
    let from_camera_m = kind.in_error_axes(state, &(origin.position_in_site_m - camera_in_site_m));
    let lambda = -n.dot(&from_camera_m) / n.dot(&ray);
    let reach_m = (from_camera_m + ray * lambda).dot(&line);
    if lambda <= 0.0 || reach_m <= 0.0 {
        return None;
    }
    let seen = kind.point_of_arm(state, &(model.camera_in_lander_m + z * reach_m), reach_m);
    let onto = ray * n.transpose() / n.dot(&ray);
    let kept = Matrix3::identity() - onto;
    let a = state.start_of(index);
    let blocks = [
        (a, kept * (1.0 - lambda)),
        (a + 3, kept * lambda),
        (POSITION, onto * seen.by_position),
        (ATTITUDE, onto * seen.by_attitude),
    ];
    let own = onto * bearing_noise(&seen, bearing) * onto.transpose();
    let position_in_site_m = origin.position_in_site_m + (end.position_in_site_m - origin.position_in_site_m) * lambda;
    let landmark = UnknownLandmark::new(bearing.track_id, position_in_site_m, origin.slot);
    Some(replaced(estimate, index, landmark, (&blocks, &own)))
}

/// The estimate with a ray's two points replaced by one, whose error is a sum of blocks of the state's.
fn replaced(
    estimate: &DescentEstimate,
    index: usize,
    landmark: UnknownLandmark,
    (blocks, own): (&[(usize, Matrix3<f64>); 4], &Matrix3<f64>),
) -> DescentEstimate {
    let n = estimate.covariance.nrows();
    let start = estimate.state.start_of(index);
    // Rows of the new error by the old: the identity, but for the new point in place of the first of the two.
    let mut by_old = DMatrix::<f64>::identity(n, n);
    by_old.fixed_rows_mut::<3>(start).fill(0.0);
    for (column, block) in blocks {
        let mut part = by_old.fixed_view_mut::<3, 3>(start, *column);
        part += block;
    }
    let by_old = by_old.remove_rows(start + 3, 3);
    let mut covariance = &by_old * &estimate.covariance * by_old.transpose();
    let mut corner = covariance.fixed_view_mut::<3, 3>(start, start);
    corner += own;
    let covariance = symmetric(&covariance);
    let mut state = estimate.state.clone();
    state.landmarks[index] = landmark;
    state.landmarks.remove(index + 1);
    DescentEstimate { state, covariance }
}
