//! A rectangle of terrain whose craters, rocks and lattices have been looked up once, for evaluating many places in it.

use super::features::{Bins, Crater, Hummock, RippleClass, RippleTables, Rock, Softened, UnitClass};
use super::relief::{FeatureSample, GroundDetail, GroundSample, OctaveSums};
use super::terrain::Terrain;
use crate::scene::noise::NoiseTable;
use nalgebra::Vector2;

/// A rectangle of terrain; gives exactly what [`Terrain::sample`] gives inside it, faster.
#[derive(Debug, Clone)]
pub struct TerrainPatch<'a> {
    terrain: &'a Terrain,
    detail: GroundDetail,
    craters: Bins<Softened<Crater>>,
    rocks: Bins<Rock>,
    hummocks: Bins<Softened<Hummock>>,
    ripples: Vec<(&'a RippleClass, RippleTables)>,
    units: Vec<(&'a UnitClass, UnitTable)>,
    octaves: Vec<Option<NoiseTable>>,
}

/// What a rectangle knows of a class of units.
#[derive(Debug, Clone)]
enum UnitTable {
    /// All of it lies on one side of the contacts.
    Side(f64),
    /// A contact may cross it.
    Crossed(Option<NoiseTable>),
}

impl Terrain {
    /// The rectangle between two corners in m, with chosen details.
    pub fn patch(&self, low_m: &Vector2<f64>, high_m: &Vector2<f64>, detail: &GroundDetail) -> TerrainPatch<'_> {
        let table = |octave: &_| NoiseTable::covering(octave, low_m, high_m);
        let shown = self.octaves().iter().take_while(|o| o.wavelength_m >= detail.height_m);
        let (middle, within_m) = (0.5 * (low_m + high_m), 0.5001 * (high_m - low_m).norm());
        let ground = OctaveSums::new(&self.octave_source(&[]), &middle, detail);
        let unit_table = |unit: &UnitClass| match unit.side_around(within_m, &ground, detail) {
            Some(side) => UnitTable::Side(side),
            None => UnitTable::Crossed(table(&unit.field)),
        };
        let craters = self.craters(detail).flat_map(|c| {
            let found = c.scatter.within(low_m, high_m);
            found.into_iter().map(|f| Softened::new(c.crater(&f), detail.feature_m))
        });
        let rocks = self.rock_classes(detail.rock_m).flat_map(|r| {
            let found = r.scatter.within(low_m, high_m).into_iter();
            found.filter(|f| f.diameter_m >= detail.rock_m).map(|f| r.rock(&f))
        });
        let hummocks = self.hummocks(detail).flat_map(|h| {
            let found = h.scatter.within(low_m, high_m);
            found.into_iter().map(|f| Softened::new(h.hummock(&f), detail.feature_m))
        });
        let ripples = self.ripples(detail).filter(|r| r.may_lie_around(&middle, within_m));
        TerrainPatch {
            terrain: self,
            detail: *detail,
            craters: Bins::new(craters, low_m, high_m),
            rocks: Bins::new(rocks, low_m, high_m),
            hummocks: Bins::new(hummocks, low_m, high_m),
            ripples: ripples.map(|r| (r, [table(&r.cover), table(&r.bend)])).collect(),
            units: self.units(detail).map(|u| (u, unit_table(u))).collect(),
            octaves: shown.map(table).collect(),
        }
    }
}

impl TerrainPatch<'_> {
    /// The ground at a place in m inside the rectangle.
    pub fn sample(&self, x_m: f64, y_m: f64) -> GroundSample {
        let at = Vector2::new(x_m, y_m);
        let mut tallest = FeatureSample::default();
        self.rocks.near(&at).iter().for_each(|rock| rock.raise(&mut tallest, &at));
        self.sample_between_rocks(x_m, y_m).under(&tallest)
    }

    /// The ground at a place in m inside the rectangle as it would be without rocks.
    fn sample_between_rocks(&self, x_m: f64, y_m: f64) -> GroundSample {
        let at = Vector2::new(x_m, y_m);
        let mut features = FeatureSample::default();
        self.craters.near(&at).iter().for_each(|crater| crater.add_to(&mut features, &at));
        self.hummocks.near(&at).iter().for_each(|hummock| hummock.add_to(&mut features, &at));
        for (class, [cover, bend]) in &self.ripples {
            class.add_to(&mut features, &at, ([cover.as_ref(), bend.as_ref()], &self.detail));
        }
        let ground = OctaveSums::new(&self.terrain.octave_source(&self.octaves), &at, &self.detail);
        for (class, table) in &self.units {
            match table {
                UnitTable::Side(side) => class.add_side_to(&mut features, &at, (*side, &self.detail)),
                UnitTable::Crossed(table) => class.add_to(&mut features, &at, (table.as_ref(), &self.detail), &ground),
            }
        }
        self.terrain.with_features(&ground, &features)
    }
}
