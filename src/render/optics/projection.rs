//! The sides and corners of the view.

use crate::geometry::Camera;
use nalgebra::{Vector2, Vector3};

/// Inward normals of the four sides of the view, in camera axes.
pub fn side_planes_in_camera(camera: &Camera) -> [Vector3<f64>; 4] {
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

/// Rays of depth 1 through the corners of the image, in camera axes.
pub fn corner_rays_in_camera(camera: &Camera) -> [Vector3<f64>; 4] {
    let size_px = Vector2::new(f64::from(camera.width_px), f64::from(camera.height_px));
    [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|share| {
        let pixel = size_px.component_mul(&Vector2::from(share)).add_scalar(-0.5);
        (pixel - camera.center_px).component_div(&camera.focal_px).push(1.0)
    })
}
