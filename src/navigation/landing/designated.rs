//! The designated point where it is not known exactly: the pixel that names it, and the tracking of it, have errors.
//!
//! What track 0 follows is then a surface point near the site's origin. It becomes a landmark of the state with a tight
//! prior, and each image lets it wander by the tracker's drift. Without errors it is the origin, as in the paper.

use super::measurement::BearingObservation;
use super::state::UnknownLandmark;
use super::{CameraMount, DescentEstimate, LandingConfig};
use crate::geometry::so3::tangent_basis;
use crate::vision::TrackObservation;
use nalgebra::{Matrix3, Vector3};

/// The estimate with the designated point's uncertainty: the whole of it at its first sight, the drift later on.
pub(super) fn with_designated_errors(
    estimate: DescentEstimate,
    bearings: &[BearingObservation],
    mount: &CameraMount,
    config: &LandingConfig,
) -> DescentEstimate {
    if config.designated_sigma_px == 0.0 && config.designated_drift_px == 0.0 {
        return estimate;
    }
    let is_designated = |b: &&BearingObservation| b.known.is_none() && b.track_id == TrackObservation::DESIGNATED;
    let Some(bearing) = bearings.iter().find(is_designated) else {
        return estimate;
    };
    let index = estimate.state.landmark_of(TrackObservation::DESIGNATED);
    let sigma_px = if index.is_some() { config.designated_drift_px } else { config.designated_sigma_px };
    let sigma_rad = sigma_px / mount.camera.mean_focal_px();
    let wander = on_ground(&estimate, bearing, mount, config, sigma_rad);
    let mut after = if index.is_some() { estimate } else { with_exact_point(estimate) };
    let start = after.state.start_of(index.unwrap_or(after.state.landmarks.len() - 1));
    let mut block = after.covariance.fixed_view_mut::<3, 3>(start, start);
    block += wander;
    after
}

/// Covariance (m²), in the filter's coordinates, of the ground point that a bearing meets where it is off by
/// `sigma_rad`; its height follows the ground's slope. 0 if it meets no ground.
fn on_ground(
    estimate: &DescentEstimate,
    bearing: &BearingObservation,
    mount: &CameraMount,
    config: &LandingConfig,
    sigma_rad: f64,
) -> Matrix3<f64> {
    let camera_in_lander_m = mount.camera_in_lander_m();
    let z = bearing.direction_in_lander.into_inner();
    let Some(spot) = config.filter.point_on_ground(&estimate.state, &z, &camera_in_lander_m, 0.0) else {
        return Matrix3::zeros();
    };
    let across = spot.by_bearing * tangent_basis(&bearing.direction_in_lander) * sigma_rad;
    let level = across * across.transpose();
    let up = config.filter.in_error_axes(&estimate.state, &Vector3::z());
    level + up * up.transpose() * (config.ground.sigma_slope.powi(2) * level.trace())
}

/// The origin as a landmark of the state, its covariance still 0.
fn with_exact_point(estimate: DescentEstimate) -> DescentEstimate {
    let mut state = estimate.state;
    state.landmarks.push(UnknownLandmark::new(TrackObservation::DESIGNATED, Vector3::zeros(), usize::MAX));
    let n = estimate.covariance.nrows() + 3;
    DescentEstimate { state, covariance: estimate.covariance.resize(n, n, 0.0) }
}
