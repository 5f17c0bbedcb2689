//! A rectangle of terrain whose craters and rocks have been looked up once, for evaluating many places in it.

use super::terrain_scatter::Feature;
use super::{CraterClass, FeatureSample, GroundDetail, GroundSample, RockClass, Terrain};
use nalgebra::Vector2;

/// A rectangle of terrain; gives exactly what [`Terrain::sample`] gives inside it, faster.
#[derive(Debug, Clone)]
pub struct TerrainPatch<'a> {
    terrain: &'a Terrain,
    detail: GroundDetail,
    craters: Vec<(&'a CraterClass, Feature)>,
    rocks: Vec<(&'a RockClass, Feature)>,
}

impl Terrain {
    /// The rectangle between two corners in m, with chosen details.
    pub fn patch(&self, low_m: &Vector2<f64>, high_m: &Vector2<f64>, detail: &GroundDetail) -> TerrainPatch<'_> {
        let craters = self.craters(detail);
        let rocks = self.rocks(detail);
        TerrainPatch {
            terrain: self,
            detail: *detail,
            craters: craters.flat_map(|c| c.scatter.within(low_m, high_m).into_iter().map(move |f| (c, f))).collect(),
            rocks: rocks.flat_map(|r| r.scatter.within(low_m, high_m).into_iter().map(move |f| (r, f))).collect(),
        }
    }
}

impl TerrainPatch<'_> {
    /// The ground at a place in m inside the rectangle.
    pub fn sample(&self, x_m: f64, y_m: f64) -> GroundSample {
        let mut features = FeatureSample::default();
        self.craters.iter().for_each(|(class, f)| class.add(f, &mut features, x_m, y_m));
        self.rocks.iter().for_each(|(class, f)| class.add(f, &mut features, x_m, y_m));
        self.terrain.relief_with(&features, x_m, y_m, &self.detail)
    }
}
