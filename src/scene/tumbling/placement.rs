//! Where a small body and the Sun stand in the camera frame.

use super::config::TumblingConfig;
use crate::geometry::Camera;
use crate::scene::body::Mesh;
use nalgebra::{Unit, Vector2, Vector3};

/// Where the camera is at the first image: at a distance from the body's centre, in m.
pub(super) fn first_distance_m(
    config: &TumblingConfig,
    camera: &Camera,
    mesh: &Mesh,
    toward_center: &Unit<Vector3<f64>>,
) -> f64 {
    if let Some(distance_m) = config.distance_m {
        return distance_m;
    }
    if let Some(range_m) = config.range_m {
        let outward = -(config.attitude() * toward_center.into_inner());
        let ground_m = mesh.last_crossing_m(&Vector3::zeros(), &outward).unwrap_or(0.0);
        return ground_m + range_m;
    }
    distance_to_fill_m(camera, mesh.radius_m(), config.fill_fraction)
}

/// Distance in m of a sphere of `radius_m` that fills `fill_fraction` of the image's smaller side when it is in the
/// middle. The silhouette of a sphere at distance D has the half-angle asin(R/D).
fn distance_to_fill_m(camera: &Camera, radius_m: f64, fill_fraction: f64) -> f64 {
    let half_side = (0.5 * size_px(camera)).component_div(&camera.focal_px).min();
    // Distortion that cannot be inverted here leaves the pinhole's size.
    let distorted = Vector2::new(half_side, 0.0);
    let half_side = camera.distortion.undistort(&distorted).unwrap_or(distorted).norm();
    radius_m / (fill_fraction * half_side).atan().sin()
}

fn size_px(camera: &Camera) -> Vector2<f64> {
    Vector2::new(f64::from(camera.width_px), f64::from(camera.height_px))
}

/// Direction in camera axes of a pixel, given from the image's middle to the right and down.
pub(super) fn toward_pixel(camera: &Camera, offset_px: &Vector2<f64>) -> Unit<Vector3<f64>> {
    let pixel_px = (0.5 * size_px(camera)).add_scalar(-0.5) + offset_px;
    // Distortion that cannot be inverted here leaves the pinhole's direction; it only moves the body a little.
    let pinhole = || (pixel_px - camera.center_px).component_div(&camera.focal_px);
    camera.unproject(&pixel_px).unwrap_or_else(|| Unit::new_normalize(pinhole().push(1.0)))
}
