//! Terrain on a measured base: procedural detail only where the base has none, and bounds of the whole.

use super::config::TerrainConfig;
use super::measured_base::GroundBase;
use super::terrain::Terrain;
use nalgebra::Vector2;
use std::sync::Arc;

/// No procedural ground departs more than this from the height of a place, per m of distance from it.
const PROCEDURAL_MEAN_SLOPE: f64 = 0.4;
/// No procedural ground departs more than this from the height of a place, in m.
const PROCEDURAL_RELIEF_M: f64 = 400.0;
/// Nothing that is no rock is higher than this in m for its place: it may stand beside the place.
const PROCEDURAL_STANDING_M: f64 = 2.0;
/// No procedural ground is steeper than this, rise over run.
const PROCEDURAL_STEEPEST: f64 = 5.0;
/// No procedural ground is above this height in m.
const PROCEDURAL_HIGHEST_M: f64 = 2_000.0;

impl Terrain {
    /// Terrain on a measured base. Octaves of waves longer than two posts, and features larger than two posts,
    /// are left to the base: the octaves' lattice cells are half a wave.
    pub fn on_base(config: &TerrainConfig, base: GroundBase, seed: u64) -> Self {
        let mut terrain = Terrain::new(config, seed);
        let resolved = |post_m: Option<f64>, detail: bool| if detail { post_m.unwrap_or(f64::INFINITY) } else { 0.0 };
        let relief_m = resolved(base.elevation.as_ref().map(|e| e.post_m()), base.relief_detail);
        let albedo_m = resolved(base.orthoimage.as_ref().map(|o| o.post_m()), base.albedo_detail);
        for octave in &mut terrain.octaves {
            octave.relief_m *= f64::from(octave.wavelength_m <= relief_m);
            octave.albedo *= f64::from(octave.wavelength_m <= albedo_m);
        }
        terrain.octaves.retain(|o| o.relief_m != 0.0 || o.albedo != 0.0);
        terrain.features.on_base([relief_m, albedo_m], &terrain.octaves);
        terrain.base = Some(Arc::new(base));
        terrain.height_at_origin_m = 0.0;
        terrain.height_at_origin_m = terrain.height_m(0.0, 0.0);
        terrain
    }

    /// What is measured of the ground.
    pub fn base(&self) -> Option<&GroundBase> {
        self.base.as_deref()
    }

    /// No ground in the square around a place, half an edge long on each side, departs more than this from the height at
    /// the place, in m.
    pub fn relief_bound_m(&self, middle_m: &Vector2<f64>, half_edge_m: f64) -> f64 {
        let reach_m = std::f64::consts::SQRT_2 * half_edge_m;
        let standing_m = (PROCEDURAL_STEEPEST * reach_m).min(PROCEDURAL_STANDING_M.max(0.8 * self.largest_rock_m()));
        let procedural_m = (PROCEDURAL_MEAN_SLOPE * reach_m).min(PROCEDURAL_RELIEF_M) + standing_m;
        let Some(elevation) = self.base.as_ref().and_then(|b| b.elevation.as_ref()) else { return procedural_m };
        procedural_m + elevation.relief_bound_m(middle_m, reach_m)
    }

    /// No ground within `distance_m` of the origin is steeper than this, rise over run.
    pub fn steepest(&self, distance_m: f64) -> f64 {
        let base = self.base.as_ref().and_then(|b| b.elevation.as_ref());
        PROCEDURAL_STEEPEST + base.map_or(0.0, |e| e.steepest(distance_m))
    }

    /// No ground is above this height in m.
    pub fn highest_m(&self) -> f64 {
        let base = self.base.as_ref().and_then(|b| b.elevation.as_ref());
        PROCEDURAL_HIGHEST_M + base.map_or(0.0, |e| e.highest_m())
    }
}
