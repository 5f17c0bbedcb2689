//! The sides of the view.

use crate::geometry::Camera;
use nalgebra::Vector3;

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
