//! Which ground a view needs: inside the image, inside the shadow map, and what stands toward the Sun.

use super::level_of_detail::ViewVolume;
use crate::geometry::Camera;
use crate::render::optics::side_planes_in_camera;
use crate::render::shading::ShadowBox;
use crate::scene::{GroundDetail, Terrain, View};
use nalgebra::{Vector2, Vector3};
use rayon::prelude::*;

/// Beyond this many heights of the camera there are no cast shadows.
const FARTHEST_HEIGHTS: f64 = 12.0;
/// Rays along either side of the image that look for the ground, less one.
const RAYS: u32 = 16;
/// Places on each ray: from the plane below the camera toward the ground that the ray meets.
const STEPS: u32 = 3;
/// Strips along the light in which ground that throws shadows into the image is looked for.
const STRIPS: usize = 16;
/// Steps along a strip grow by this share.
const STRIDE: f64 = 0.1;

/// What the camera sees of the ground, and what throws shadows into it.
#[derive(Debug, Clone, Copy)]
pub struct SeenGround {
    /// Box around the ground in the image, deep enough for what throws shadows.
    pub covered: ShadowBox,
    /// How far from the image ground throws shadows into it, along the light, m.
    reach_m: f64,
}

impl SeenGround {
    /// The ground before a camera `height_m` above it.
    pub fn new(terrain: &Terrain, (camera, view): (&Camera, &View), height_m: f64) -> SeenGround {
        let places_m = places_seen(terrain, (camera, view), height_m);
        let fitted = ShadowBox::around(&view.sun_in_reference, &places_m);
        let margin_m = 0.05 * height_m;
        let (half_x_m, half_y_m) = (1.05 * fitted.half_m.x + margin_m, 1.05 * fitted.half_m.y + margin_m);
        let widest_m = half_x_m.max(half_y_m);
        // Rocks and rims that stand between the places looked at.
        let least_m = 2.0 + 0.06 * widest_m / view.sun_in_reference.z.max(0.05);
        let reach_m = least_m.max(shadow_reach_m(terrain, view, (&places_m, 0.1 * widest_m)));
        let half_z_m = fitted.half_m.z + (2.0 * widest_m).max(500.0);
        // The map begins before all that throws shadows.
        let toward_sun_m = 0.5 * (1.1 * reach_m - (half_z_m - fitted.half_m.z)).max(0.0);
        let covered = ShadowBox {
            half_m: Vector3::new(half_x_m, half_y_m, half_z_m + toward_sun_m),
            center_m: fitted.center_m + view.sun_in_reference.as_ref() * toward_sun_m,
            ..fitted
        };
        SeenGround { covered, reach_m }
    }

    /// What has to be drawn of it.
    pub fn volume(&self, camera: &Camera, view: &View) -> ViewVolume {
        let rotation = view.reference_from_camera.rotation;
        ViewVolume {
            camera_in_site_m: view.reference_from_camera.translation.vector,
            sides_in_site: side_planes_in_camera(camera).map(|n| rotation * n),
            shadow_in_site_m: -view.sun_in_reference.into_inner() * self.reach_m,
        }
    }
}

/// Details of the ground that are at least this large.
fn coarse(smallest_m: f64) -> GroundDetail {
    GroundDetail {
        height_m: smallest_m,
        shade_m: f64::INFINITY,
        feature_m: smallest_m,
        rock_m: 0.5 * smallest_m,
        footprint_m: 0.0,
    }
}

/// Places on the ground in the image, relative to the camera, m.
fn places_seen(terrain: &Terrain, (camera, view): (&Camera, &View), height_m: f64) -> Vec<Vector3<f64>> {
    let eye_m = view.reference_from_camera.translation.vector;
    let detail = coarse(height_m / f64::from(2 * RAYS));
    let along_ray = |k: u32| {
        let share = |i: u32, size: u32| f64::from(i) / f64::from(RAYS) * f64::from(size) - 0.5;
        let u = share(k % (RAYS + 1), camera.width_px);
        let v = share(k / (RAYS + 1), camera.height_px);
        let ideal = (Vector2::new(u, v) - camera.center_px).component_div(&camera.focal_px);
        let ray = view.reference_from_camera.rotation * ideal.push(1.0);
        let steep = (-ray.z).max(ray.xy().norm() / FARTHEST_HEIGHTS).max(1e-9);
        let mut below_m = height_m;
        [(); STEPS as usize].map(|()| {
            let place_m = ray.xy() * (below_m.clamp(0.0, 2.0 * height_m) / steep);
            let at_m = place_m + eye_m.xy();
            below_m = eye_m.z - terrain.sample(at_m.x, at_m.y, &detail).height_m;
            place_m.push(-below_m)
        })
    };
    (0..(RAYS + 1) * (RAYS + 1)).into_par_iter().flat_map_iter(along_ray).collect()
}

/// How far along the light the ground lies that throws shadows onto places (relative to the camera, m) from outside of
/// them, looked for from `first_m` on; 0 if none does.
fn shadow_reach_m(terrain: &Terrain, view: &View, (places_m, first_m): (&[Vector3<f64>], f64)) -> f64 {
    let sun = view.sun_in_reference;
    let level = sun.xy().norm().max(1e-6);
    let tangent = sun.z.max(0.02) / level;
    let (toward, eye_m) = (sun.xy() / level, view.reference_from_camera.translation.vector);
    let across = Vector2::new(-toward.y, toward.x);
    let lateral_m: Vec<f64> = places_m.iter().map(|p| across.dot(&p.xy())).collect();
    let low_m = lateral_m.iter().copied().fold(f64::INFINITY, f64::min);
    let strip_m = (lateral_m.iter().copied().fold(f64::NEG_INFINITY, f64::max) - low_m) / STRIPS as f64;
    let reach_of = |strip: usize| {
        let mut end_m = f64::NEG_INFINITY;
        let mut lowest_m = f64::INFINITY;
        for (place_m, lateral_m) in places_m.iter().zip(&lateral_m) {
            if ((lateral_m - low_m) / strip_m - strip as f64 - 0.5).abs() <= 0.5 {
                end_m = end_m.max(toward.dot(&place_m.xy()));
                lowest_m = lowest_m.min(place_m.z + eye_m.z);
            }
        }
        let middle_m = eye_m.xy() + across * (low_m + (strip as f64 + 0.5) * strip_m);
        let (mut away_m, mut reach_m) = (first_m, 0.0);
        while away_m * tangent < terrain.highest_m() - lowest_m {
            let at_m = middle_m + toward * (end_m + away_m);
            let height_m = terrain.sample(at_m.x, at_m.y, &coarse(STRIDE * away_m)).height_m;
            if height_m - lowest_m > away_m * tangent {
                reach_m = (1.0 + STRIDE) * away_m;
            }
            away_m *= 1.0 + STRIDE;
        }
        reach_m / level
    };
    (0..STRIPS).into_par_iter().map(reach_of).reduce(|| 0.0, f64::max)
}
