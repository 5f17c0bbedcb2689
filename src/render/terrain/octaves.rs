//! Which octaves of the ground's detail an image adds to what vertices carry.

use super::level_of_detail::LevelRange;
use crate::geometry::Camera;
use crate::render::optics::corner_rays_in_camera;
use crate::scene::View;
use nalgebra::Vector3;

/// Margin for rounding on the adapter.
const MARGIN: f64 = 0.02;

/// Wavelengths of the octaves that any pixel of an image may show and vertices do not carry there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShadedWavelengths {
    /// Vertices carry octaves of this wavelength in m and more everywhere in the image.
    pub carried_m: f64,
    /// No pixel is smaller on the ground, in m.
    pub finest_m: f64,
}

impl ShadedWavelengths {
    /// Of ground between two heights in m, seen by a pinhole camera whose pixels are those of focal length `focal_px`.
    pub fn new(
        (pinhole, view): (&Camera, &View),
        levels: &LevelRange,
        [lowest_m, highest_m]: [f64; 2],
        focal_px: f64,
    ) -> Self {
        let eye_m = view.reference_from_camera.translation.vector;
        // Of depth 1: what a ray falls, and how far it leads away, are largest in a corner of the image.
        let rays = corner_rays_in_camera(pinhole).map(|ray| view.reference_from_camera.rotation * ray);
        let steepest = rays.iter().map(|ray| -ray.z).fold(0.0, f64::max);
        let nearest_m = (eye_m.z - highest_m).max(0.0) / steepest.max(1e-9);
        let farthest = rays.iter().map(away_by_fall).fold(0.0, f64::max);
        let farthest_m = (farthest * (eye_m.z - lowest_m).max(0.0)).hypot(levels.height_m);
        ShadedWavelengths {
            carried_m: levels.carried_m((1.0 + MARGIN) * farthest_m),
            finest_m: (1.0 - MARGIN) * nearest_m / focal_px,
        }
    }
}

/// How far a ray leads away for each metre that it falls; without bounds for one that does not.
fn away_by_fall(ray: &Vector3<f64>) -> f64 {
    if ray.z < 0.0 { ray.xy().norm() / -ray.z } else { f64::INFINITY }
}
