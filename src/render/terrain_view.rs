//! Which ground a view needs: inside the picture, and inside the shadow map.

use super::projection::side_planes_in_camera;
use super::shadow::ShadowBox;
use super::terrain_levels::ViewVolume;
use crate::geometry::Camera;
use crate::scene::View;
use nalgebra::Vector3;

/// What the camera sees of the ground, and what can throw a shadow into it.
pub(super) fn view_volume(camera: &Camera, view: &View, covered: &ShadowBox) -> ViewVolume {
    let rotation = view.reference_from_camera.rotation;
    // Gentle terrain: what stands a few per cent of the picture's width higher throws its shadow this far.
    let reach_m = 2.0 + 0.06 * covered.half_m.xy().max() / view.sun_in_reference.z.max(0.05);
    ViewVolume {
        camera_in_site_m: view.reference_from_camera.translation.vector,
        sides_in_site: side_planes_in_camera(camera).map(|n| rotation * n),
        shadow_in_site_m: -view.sun_in_reference.into_inner() * reach_m,
    }
}

/// Box around the ground in view; beyond `FARTHEST_HEIGHTS` heights of the camera there are no cast shadows.
pub(super) fn ground_box(camera: &Camera, view: &View, height_m: f64) -> ShadowBox {
    const FARTHEST_HEIGHTS: f64 = 12.0;
    const RAYS: u32 = 16;
    let mut places_m = Vec::with_capacity(((RAYS + 1) * (RAYS + 1)) as usize);
    for k in 0..(RAYS + 1) * (RAYS + 1) {
        let share = |i: u32, size: u32| f64::from(i) / f64::from(RAYS) * f64::from(size) - 0.5;
        let u = share(k % (RAYS + 1), camera.width_px);
        let v = share(k / (RAYS + 1), camera.height_px);
        let ideal = Vector3::new(
            (u - camera.center_px.x) / camera.focal_px.x,
            (v - camera.center_px.y) / camera.focal_px.y,
            1.0,
        );
        let ray = view.reference_from_camera.rotation * ideal;
        let steep = (-ray.z).max(ray.xy().norm() / FARTHEST_HEIGHTS).max(1e-9);
        places_m.push(Vector3::new(ray.x, ray.y, 0.0) * (height_m / steep) - Vector3::z() * height_m);
    }
    let fitted = ShadowBox::around(&view.sun_in_reference, &places_m);
    let margin_m = 0.05 * height_m;
    let (half_x_m, half_y_m) = (1.05 * fitted.half_m.x + margin_m, 1.05 * fitted.half_m.y + margin_m);
    // Deep enough for relief that stands before and behind the ground in view.
    let half_z_m = fitted.half_m.z + (2.0 * half_x_m.max(half_y_m)).max(500.0);
    ShadowBox { half_m: Vector3::new(half_x_m, half_y_m, half_z_m), ..fitted }
}
