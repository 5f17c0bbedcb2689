//! Stars behind the surface.

use super::frame::RenderedFrame;
use crate::geometry::Camera;
use crate::scene::Sky;
use nalgebra::{UnitQuaternion, Vector2, Vector3};

/// Cosine of the angle by which a star may miss its own pixel: beyond it, the lens model has folded back on itself.
const LEAST_COSINE: f64 = 1.0 - 1e-9;

/// Adds the stars to the image's radiance: each shares its light among the four pixels around its place, so that their
/// centroid is that place. A star is hidden where the ray of the nearest pixel hits the surface.
pub fn add_stars(frame: &mut RenderedFrame, camera: &Camera, sky: &Sky, camera_from_inertial: &UnitQuaternion<f64>) {
    for star in &sky.stars {
        let in_camera = camera_from_inertial * star.direction.as_ref();
        if let Some(pixel) = place(camera, &in_camera).filter(|pixel| !is_hidden(frame, pixel)) {
            share(frame, &pixel, sky.light_if_px(star, camera));
        }
    }
}

/// Pixel of a direction in camera axes, if it lies in the image or within a pixel of its edge.
fn place(camera: &Camera, in_camera: &Vector3<f64>) -> Option<Vector2<f64>> {
    let pixel = camera.project(in_camera).filter(|pixel| camera.contains(pixel, -1.0))?;
    let back = camera.unproject(&pixel)?;
    (back.dot(in_camera) > LEAST_COSINE).then_some(pixel)
}

fn is_hidden(frame: &RenderedFrame, pixel: &Vector2<f64>) -> bool {
    let nearest = |at: f64, size_px: u32| at.round().clamp(0.0, f64::from(size_px) - 1.0) as u32;
    frame.depth_m[frame.index(nearest(pixel.x, frame.width_px), nearest(pixel.y, frame.height_px))].is_finite()
}

fn share(frame: &mut RenderedFrame, pixel: &Vector2<f64>, light: f64) {
    let corner = pixel.map(f64::floor);
    let part = pixel - corner;
    for (right, down) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
        let (u, v) = (corner.x + right, corner.y + down);
        let inside = (0.0..f64::from(frame.width_px)).contains(&u) && (0.0..f64::from(frame.height_px)).contains(&v);
        if inside {
            let weight = (1.0 - (right - part.x).abs()) * (1.0 - (down - part.y).abs());
            let index = frame.index(u as u32, v as u32);
            frame.radiance[index] += (light * weight) as f32;
        }
    }
}
