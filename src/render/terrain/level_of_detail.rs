//! Chooses the tiles of a view: fine near the camera, coarse far away.
//!
//! Source: Strugar, "Continuous Distance-Dependent Level of Detail for Rendering Heightmaps", Journal of Graphics, GPU,
//! and Game Tools 14(4), 2009. Distance is taken from the place on a plane `height_m` below the camera, so that it is
//! the same for every vertex that tiles share.

use super::rocks::rock_reach_m;
use super::tile::{COARSEST_LEVEL, FINEST_LEVEL, SHADE_SPACINGS, SIDE, TileKey};
use crate::scene::Terrain;
use nalgebra::{Vector2, Vector3};

/// Least range over spacing for which a tile never borders on one two levels away.
const LEAST_RANGE_OVER_SPACING: f64 = 160.0;
/// A level's vertices keep their places up to this share of its range, or farther out where its tiles are large.
const LEAST_MORPH_START: f64 = 0.85;
/// A level's vertices have reached the coarser grid at this share of its range; the rest is a guard for rounding.
const MORPH_END: f64 = 0.98;

/// Where levels begin and end.
#[derive(Debug, Clone, Copy)]
pub struct LevelRange {
    /// Height of the camera above the ground in m.
    pub height_m: f64,
    /// Distance up to which a level is used, over its spacing of vertices.
    pub range_over_spacing: f64,
    /// Share of a level's range at which its vertices begin to slide.
    pub morph_start: f64,
    /// Share of a level's range at which its vertices have become those of the coarser level.
    pub morph_end: f64,
}

impl LevelRange {
    pub fn new(height_m: f64, focal_px: f64, vertex_spacing_px: f64) -> Self {
        let range_over_spacing = (focal_px / vertex_spacing_px).max(LEAST_RANGE_OVER_SPACING);
        let diagonal = (SIDE - 1) as f64 * std::f64::consts::SQRT_2;
        let morph_start = (0.51 + diagonal / range_over_spacing).max(LEAST_MORPH_START);
        LevelRange { height_m, range_over_spacing, morph_start, morph_end: MORPH_END }
    }

    fn range_m(&self, level: i32) -> f64 {
        self.range_over_spacing * 2.0_f64.powi(level)
    }

    /// Octaves of this wavelength in m and more are the vertices' to carry at a distance in m and nearer, be they slid onto
    /// the coarser grid or not: `carried_by` in `shaders/shading.wgsl`.
    pub(super) fn carried_m(&self, distance_m: f64) -> f64 {
        let levels = f64::from(FINEST_LEVEL)..=f64::from(COARSEST_LEVEL);
        let level = (distance_m / self.range_over_spacing).log2().ceil().clamp(*levels.start(), *levels.end());
        let has_slid = distance_m > self.morph_start * self.range_over_spacing * level.exp2();
        SHADE_SPACINGS * (level + f64::from(u8::from(has_slid))).exp2()
    }
}

/// What has to be drawn: all that the camera sees and all that can throw a shadow into it.
#[derive(Debug, Clone, Copy)]
pub struct ViewVolume {
    pub camera_in_site_m: Vector3<f64>,
    /// Inward normals of the view's sides, in the site frame.
    pub sides_in_site: [Vector3<f64>; 4],
    /// How far a shadow reaches, in m along the light.
    pub shadow_in_site_m: Vector3<f64>,
}

/// Tiles in a fixed order.
pub(super) fn choose_tiles(terrain: &Terrain, volume: &ViewVolume, levels: &LevelRange) -> Vec<TileKey> {
    let mut chosen = Vec::new();
    for (x, y) in [(-1, -1), (0, -1), (-1, 0), (0, 0)] {
        descend(TileKey { level: COARSEST_LEVEL, x, y }, terrain, volume, levels, &mut chosen);
    }
    chosen
}

fn descend(key: TileKey, terrain: &Terrain, volume: &ViewVolume, levels: &LevelRange, chosen: &mut Vec<TileKey>) {
    if !touches(&key, terrain, volume) {
        return;
    }
    let split = key.level > FINEST_LEVEL && nearest_m(&key, volume, levels) < levels.range_m(key.level - 1);
    if split {
        key.children().into_iter().for_each(|child| descend(child, terrain, volume, levels, chosen));
    } else {
        chosen.push(key);
    }
}

fn nearest_m(key: &TileKey, volume: &ViewVolume, levels: &LevelRange) -> f64 {
    let outside = |low: f64, at: f64| (low - at).max(at - low - key.edge_m()).max(0.0);
    let [x_m, y_m] = key.corner_m();
    let camera = &volume.camera_in_site_m;
    Vector3::new(outside(x_m, camera.x), outside(y_m, camera.y), levels.height_m).norm()
}

fn touches(key: &TileKey, terrain: &Terrain, volume: &ViewVolume) -> bool {
    let [x_m, y_m] = key.corner_m();
    let middle = Vector2::new(x_m, y_m).add_scalar(0.5 * key.edge_m());
    let half_m = 0.5 * key.edge_m() + rock_reach_m(terrain, key.spacing_m());
    let relief_m = terrain.relief_bound_m(&middle, half_m);
    let height_m = terrain.sample(middle.x, middle.y, &key.detail()).height_m;
    let shadow_m = 0.5 * volume.shadow_in_site_m;
    let half = Vector3::new(half_m, half_m, relief_m) + shadow_m.abs();
    volume.shows(&(middle.push(height_m) + shadow_m), &half)
}

impl ViewVolume {
    /// Whether the camera may see a tile whose vertices lie between two heights in m, and reach out of it by a distance in m.
    pub(super) fn shows_tile(&self, key: &TileKey, [lowest_m, highest_m]: [f64; 2], reach_m: f64) -> bool {
        let [x_m, y_m] = key.corner_m();
        let half = 0.5 * Vector3::new(key.edge_m(), key.edge_m(), highest_m - lowest_m);
        let reach = Vector3::new(reach_m, reach_m, 0.0);
        self.shows(&(Vector3::new(x_m, y_m, lowest_m) + half), &(half + reach))
    }

    /// Whether the camera may see something of a box with a middle and half sides in m.
    fn shows(&self, middle_in_site_m: &Vector3<f64>, half_m: &Vector3<f64>) -> bool {
        let center = middle_in_site_m - self.camera_in_site_m;
        self.sides_in_site.iter().all(|n| n.dot(&center) + n.abs().dot(half_m) >= 0.0)
    }
}
