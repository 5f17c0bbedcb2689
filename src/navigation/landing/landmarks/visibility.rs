//! Which features of an image may become an unknown landmark.

use crate::navigation::landing::bearings::{BearingObservation, CameraMount};
use crate::navigation::landing::config::LandingConfig;
use crate::navigation::landing::error_state::{DescentEstimate, DescentState};
use crate::navigation::landing::inertial::ImuIncrement;
use crate::navigation::landmark::Viewpoint;
use nalgebra::Vector3;

/// The estimated state as landmark selection wants it; the next images are taken to follow as the last one did.
pub fn viewpoint(
    estimate: &DescentEstimate,
    increment: &ImuIncrement,
    sigma_bearing_rad: f64,
    config: &LandingConfig,
) -> Viewpoint {
    let state = &estimate.state;
    let interval_s = increment.duration_s.max(1e-3);
    let force_in_lander = increment.after_from_before() * increment.velocity_in_before_m_s / interval_s;
    Viewpoint {
        lander_in_site_m: state.lander_in_site_m,
        lander_velocity_in_site_m_s: state.lander_velocity_in_site_m_s,
        specific_force_in_site_m_s2: state.lander_from_site.inverse() * force_in_lander,
        gravity_in_site_m_s2: config.planet().gravity_in_site_m_s2,
        interval_s,
        sigma_bearing_rad,
        covariance: config.filter.site_covariance(estimate),
        ground: config.ground,
    }
}

/// Whether the ground point that a bearing meets will still be in the image, `margin_px` from its edge, at each of the
/// next `images` images, by the estimated motion and a steady rate of turn.
pub fn survives(
    state: &DescentState,
    bearing: &BearingObservation,
    mount: &CameraMount,
    ahead: &LookAhead<'_>,
) -> bool {
    let camera_in_lander_m = mount.camera_in_lander_m();
    let z = bearing.direction_in_lander.into_inner();
    let Some((point_m, _)) = crate::navigation::landing::error_state::ground_point(state, &z, &camera_in_lander_m, 0.0)
    else {
        return false;
    };
    let mut lander_from_site = state.lander_from_site;
    (0..=ahead.images).all(|image| {
        if image > 0 {
            lander_from_site = ahead.increment.before_from_after.inverse() * lander_from_site;
        }
        let time_s = image as f64 * ahead.increment.duration_s;
        let lander_m = ahead.view.predicted_position_in_site_m(time_s);
        is_in_image(&(lander_from_site * (point_m - lander_m)), mount, ahead.margin_px)
    })
}

/// How far, and by what motion, to look ahead.
#[derive(Debug, Clone, Copy)]
pub struct LookAhead<'a> {
    /// The estimated motion.
    pub view: &'a Viewpoint,
    /// The last interval between two images.
    pub increment: &'a ImuIncrement,
    /// Number of images ahead.
    pub images: usize,
    /// Distance to keep from the image's edge, px.
    pub margin_px: f64,
}

fn is_in_image(relative_in_lander_m: &Vector3<f64>, mount: &CameraMount, margin_px: f64) -> bool {
    let in_camera = mount.lander_from_camera.inverse_transform_point(&(*relative_in_lander_m).into());
    let pixel = mount.camera.project(&in_camera.coords);
    pixel.is_some_and(|pixel| mount.camera.contains(&pixel, margin_px))
}
