//! From camera axes to clip space.

use crate::geometry::Camera;
use nalgebra::{Matrix4, Vector3};

/// Nearest depth in m that is drawn.
pub(super) const NEAR_M: f64 = 0.005;

/// Reversed, infinite projection: depth is `NEAR_M / z`. The target's sample centres lie at +0.5, ours at whole pixels:
/// hence the half pixel, here and nowhere else on the CPU.
pub(super) fn clip_from_camera(camera: &Camera) -> Matrix4<f64> {
    let (width, height) = (f64::from(camera.width_px), f64::from(camera.height_px));
    let (focal, center) = (camera.focal_px, camera.center_px.add_scalar(0.5));
    #[rustfmt::skip]
    let matrix = Matrix4::new(
        2.0 * focal.x / width, 0.0, 2.0 * center.x / width - 1.0, 0.0,
        0.0, -2.0 * focal.y / height, 1.0 - 2.0 * center.y / height, 0.0,
        0.0, 0.0, 0.0, NEAR_M,
        0.0, 0.0, 1.0, 0.0,
    );
    matrix
}

/// Inward normals of the four sides of the view, in camera axes.
pub(super) fn side_planes_in_camera(camera: &Camera) -> [Vector3<f64>; 4] {
    let ideal = |pixel: f64, center: f64, focal: f64| (pixel - center) / focal;
    let left = ideal(-0.5, camera.center_px.x, camera.focal_px.x);
    let right = ideal(f64::from(camera.width_px) - 0.5, camera.center_px.x, camera.focal_px.x);
    let top = ideal(-0.5, camera.center_px.y, camera.focal_px.y);
    let bottom = ideal(f64::from(camera.height_px) - 0.5, camera.center_px.y, camera.focal_px.y);
    [
        Vector3::new(1.0, 0.0, -left),
        Vector3::new(-1.0, 0.0, right),
        Vector3::new(0.0, 1.0, -top),
        Vector3::new(0.0, -1.0, bottom),
    ]
}
