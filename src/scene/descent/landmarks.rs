//! Landmarks around the landing site.

use crate::dataset::truth::Landmark;
use crate::scene::terrain::Terrain;
use nalgebra::Vector3;

/// Distance of the nearest landmark from the site, m.
const NEAREST_M: f64 = 2.0;
/// Turn between successive landmarks: the golden angle, so that no direction is left out.
const TURN_RAD: f64 = 2.399_963_229_728_653;

/// `count` points of the ground: the site itself, then points on a spiral whose radius grows by a constant ratio up to
/// `farthest_m`, so that every height has some of them in its image.
pub fn landmarks_around_site(terrain: &Terrain, count: usize, farthest_m: f64) -> Vec<Landmark> {
    let ratio = (farthest_m / NEAREST_M).max(1.0);
    let position_m = |index: usize| {
        if index == 0 {
            return Vector3::zeros();
        }
        let radius_m = NEAREST_M * ratio.powf((index - 1) as f64 / (count - 2).max(1) as f64);
        let (sin, cos) = (index as f64 * TURN_RAD).sin_cos();
        let (x_m, y_m) = (radius_m * cos, radius_m * sin);
        Vector3::new(x_m, y_m, terrain.height_m(x_m, y_m))
    };
    (0..count).map(|index| Landmark { id: index as u32, position_m: position_m(index) }).collect()
}
