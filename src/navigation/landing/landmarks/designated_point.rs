//! The designated point where it is not known exactly: the pixel that names it, and the tracking of it, have errors.
//!
//! What track 0 follows is then a surface point near the site's origin. It becomes a landmark of the state with a tight
//! prior, and each image lets it wander by the tracker's drift. Without errors it is the origin, as in the paper.

use crate::geometry::so3::tangent_basis;
use crate::navigation::landing::bearings::{BearingObservation, CameraMount};
use crate::navigation::landing::config::LandingConfig;
use crate::navigation::landing::error_state::{DescentEstimate, UnknownLandmark};
use crate::observations::TrackObservation;
use nalgebra::{Matrix3, Vector3};

/// The estimate with the designated point's uncertainty: the whole of it at its first sight, the drift later on.
pub fn with_designated_errors(
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
    let wander = on_ground(&estimate, bearing, mount, config, sigma_px);
    let mut after = if index.is_some() { estimate } else { with_exact_point(estimate) };
    let start = after.state.start_of(index.unwrap_or(after.state.landmarks.len() - 1));
    let mut block = after.covariance.fixed_view_mut::<3, 3>(start, start);
    block += wander;
    after
}

/// Covariance (m²), in the filter's coordinates, of the ground point that a bearing meets where its pixel is off by
/// `sigma_px` in each coordinate; its height follows the ground's slope. 0 if it meets no ground.
fn on_ground(
    estimate: &DescentEstimate,
    bearing: &BearingObservation,
    mount: &CameraMount,
    config: &LandingConfig,
    sigma_px: f64,
) -> Matrix3<f64> {
    let camera_in_lander_m = mount.camera_in_lander_m();
    let z = bearing.direction_in_lander.into_inner();
    let Some(spot) = config.filter.point_on_ground(&estimate.state, &z, &camera_in_lander_m, 0.0) else {
        return Matrix3::zeros();
    };
    let Some(angle_by_pixel) = mount.angle_by_pixel(&bearing.direction_in_lander) else {
        return Matrix3::zeros();
    };
    let across = spot.by_bearing * tangent_basis(&bearing.direction_in_lander) * angle_by_pixel * sigma_px;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Camera;
    use crate::navigation::landing::error_state::DescentState;
    use crate::navigation::landing::error_state::ground_point;
    use nalgebra::{DMatrix, Isometry3, Matrix3x2, Translation3, UnitQuaternion, Vector2};
    use std::f64::consts::{FRAC_PI_2, PI};

    /// The covariance of the ground point below a pixel, and the same by differences of the pixel, both in site axes (m²)
    /// and for 0.2 px.
    fn analytic_and_numeric(pixel_px: Vector2<f64>) -> (Matrix3<f64>, Matrix3<f64>) {
        const SIGMA_PX: f64 = 0.2;
        let mount = CameraMount {
            camera: Camera::from_fov(1024, 1024, FRAC_PI_2),
            lander_from_camera: Isometry3::from_parts(
                Translation3::new(0.5, -0.2, -1.0),
                UnitQuaternion::from_euler_angles(PI, 0.0, 0.0),
            ),
        };
        let state = DescentState {
            lander_in_site_m: Vector3::new(900.0, -1400.0, 3000.0),
            lander_velocity_in_site_m_s: Vector3::zeros(),
            lander_from_site: UnitQuaternion::from_euler_angles(0.05, -0.1, 0.4),
            biases: None,
            landmarks: Vec::new(),
        };
        let mut config = LandingConfig::default();
        config.ground.sigma_slope = 0.0;
        let seen = |pixel_px: Vector2<f64>| {
            let observation = TrackObservation { t_ns: 0, track_id: 0, pixel_px, sigma_px: 1.0, response: 0.0 };
            mount.bearing(&observation, 0.0).expect("in the picture")
        };
        let at = |pixel_px: Vector2<f64>| {
            let direction = seen(pixel_px).direction_in_lander.into_inner();
            ground_point(&state, &direction, &mount.camera_in_lander_m(), 0.0).expect("ground").0
        };
        let by = |step: Vector2<f64>| (at(pixel_px + step) - at(pixel_px - step)) * 0.5;
        let by_pixel = Matrix3x2::from_columns(&[by(Vector2::x()), by(Vector2::y())]);
        let turn = state.lander_from_site.inverse().to_rotation_matrix().into_inner();
        let estimate = DescentEstimate { state: state.clone(), covariance: DMatrix::zeros(9, 9) };
        let analytic = on_ground(&estimate, &seen(pixel_px), &mount, &config, SIGMA_PX);
        (turn * analytic * turn.transpose(), by_pixel * by_pixel.transpose() * SIGMA_PX.powi(2))
    }

    #[test]
    fn a_pixel_off_the_axis_covers_as_much_ground_as_its_rays_meet() {
        for pixel_px in [Vector2::new(511.5, 511.5), Vector2::new(340.0, 910.0), Vector2::new(1000.0, 30.0)] {
            let (analytic, numeric) = analytic_and_numeric(pixel_px);
            assert!((analytic - numeric).norm() < 1e-4 * numeric.norm(), "{pixel_px}: {analytic} {numeric}");
        }
        let (off_axis, on_axis) = (Vector2::new(340.0, 910.0), Vector2::new(511.5, 511.5));
        let (analytic, _) = analytic_and_numeric(on_axis);
        let (_, numeric) = analytic_and_numeric(off_axis);
        assert!((analytic - numeric).norm() > 0.02 * numeric.norm(), "another pixel is told from it");
    }
}
