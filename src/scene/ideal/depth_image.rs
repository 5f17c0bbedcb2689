//! What an image's depths say of points in space: seen, or hidden by something nearer.

use crate::dataset::truth::{Landmark, LandmarkObservation};
use crate::scene::camera::SceneCamera;
use crate::scene::view::View;
use nalgebra::Vector2;

/// z-depths of an image in m at pixel centres, rows from the top, NaN where nothing is hit.
#[derive(Debug, Clone, Copy)]
pub struct DepthImage<'a> {
    /// Width in px.
    pub width_px: u32,
    /// The depths.
    pub depth_m: &'a [f32],
}

/// Relative agreement of depths under which a landmark counts as not hidden. Landmarks lie on the exact surface, the
/// image shows a mesh.
const LANDMARK_TOLERANCE: f64 = 0.01;

impl DepthImage<'_> {
    /// Depth at the pixel nearest to a place; NaN outside the image.
    pub fn nearest_m(&self, pixel_px: &Vector2<f64>) -> f64 {
        self.at(pixel_px.x.round() as i64, pixel_px.y.round() as i64)
    }

    fn at(&self, u: i64, v: i64) -> f64 {
        let width = i64::from(self.width_px);
        let inside = (0..width).contains(&u) && v >= 0;
        let index = usize::try_from(v * width + u).ok().filter(|_| inside);
        index.and_then(|index| self.depth_m.get(index)).map_or(f64::NAN, |depth| f64::from(*depth))
    }

    /// Whether a point that falls on a pixel at this depth lies on what the image shows: between the nearest and the
    /// farthest of the four pixels around it, give or take the relative tolerance.
    pub fn shows(&self, pixel_px: &Vector2<f64>, depth_m: f64, tolerance: f64) -> bool {
        let (u, v) = (pixel_px.x.floor() as i64, pixel_px.y.floor() as i64);
        let around = [(u, v), (u + 1, v), (u, v + 1), (u + 1, v + 1)].map(|(u, v)| self.at(u, v));
        // f64::min and max pass over NaN.
        let nearest_m = around.into_iter().fold(f64::INFINITY, f64::min);
        let farthest_m = around.into_iter().fold(0.0, f64::max);
        depth_m >= nearest_m * (1.0 - tolerance) && depth_m <= farthest_m * (1.0 + tolerance)
    }
}

/// Projects landmarks into an image; those within it are listed, visible where the drawn depth agrees.
pub fn observe_landmarks(
    landmarks: &[Landmark],
    camera: &SceneCamera,
    view: &View,
    depth: &DepthImage,
) -> Vec<LandmarkObservation> {
    let lens = &camera.sensor.camera;
    let observe = |landmark: &Landmark| {
        let point_m = view.reference_from_camera.inverse_transform_point(&landmark.position_m.into());
        let pixel_px = lens.project(&point_m.coords).filter(|pixel| lens.contains(pixel, 0.0))?;
        let visible = (depth.nearest_m(&pixel_px) - point_m.z).abs() <= LANDMARK_TOLERANCE * point_m.z;
        Some(LandmarkObservation { t_ns: view.t_ns, camera: camera.id.number, id: landmark.id, pixel_px, visible })
    };
    landmarks.iter().filter_map(observe).collect()
}
