//! Optical flow of a static surface, from depth and poses.

use super::depth_image::DepthImage;
use crate::dataset::truth::OpticalFlow;
use crate::geometry::Camera;
use crate::scene::view::View;
use nalgebra::{Point3, Vector2};

/// Relative agreement of depths under which a point counts as seen in the next image.
const TOLERANCE: f64 = 1e-3;

/// Motion of every pixel's surface point from one image of a camera to its next one: the pixel's centre is taken into
/// space by its depth and lens, in f64, and projected by the next view. NaN where there is no surface, or where the point
/// leaves the image or is hidden in the next one.
pub fn optical_flow(
    camera: &Camera,
    (view, depth): (&View, &DepthImage),
    (next, next_depth): (&View, &DepthImage),
) -> OpticalFlow {
    let next_from_this = next.reference_from_camera.inv_mul(&view.reference_from_camera);
    let motion = |(index, depth_m): (usize, &f32)| -> Option<Vector2<f32>> {
        let depth_m = Some(f64::from(*depth_m)).filter(|depth_m| depth_m.is_finite())?;
        let width = depth.width_px as usize;
        let pixel_px = Vector2::new((index % width) as f64, (index / width) as f64);
        let point_m = Point3::from(camera.normalize(&pixel_px)?.push(1.0) * depth_m);
        let in_next_m = next_from_this * point_m;
        let next_px = camera.project(&in_next_m.coords).filter(|pixel| camera.contains(pixel, 0.0))?;
        let seen = next_depth.shows(&next_px, in_next_m.z, TOLERANCE);
        seen.then(|| (next_px - pixel_px).map(|v| v as f32))
    };
    let unknown = Vector2::repeat(f32::NAN);
    let motion_px = depth.depth_m.iter().enumerate().map(|pixel| motion(pixel).unwrap_or(unknown)).collect();
    OpticalFlow { width_px: camera.width_px, height_px: camera.height_px, motion_px }
}
