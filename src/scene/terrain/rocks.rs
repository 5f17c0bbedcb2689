//! The rocks of a terrain: which there are in a rectangle, and how many in the mean.

use super::features::{Rock, RockClass};
use super::terrain::Terrain;
use nalgebra::Vector2;

impl Terrain {
    /// Classes that may hold rocks of a diameter in m and more.
    pub(in crate::scene) fn rock_classes(&self, smallest_m: f64) -> impl Iterator<Item = &RockClass> {
        self.features.rocks.iter().take_while(move |r| 2.0 * r.scatter.smallest_m >= smallest_m)
    }

    /// Rocks of the diameters between two, in m, whose centres lie between two corners (site frame, m): on the lower and
    /// left border, not on the upper and right one.
    pub fn rocks_in(
        &self,
        low_m: &Vector2<f64>,
        high_m: &Vector2<f64>,
        [smallest_m, largest_m]: [f64; 2],
    ) -> Vec<Rock> {
        let inside = |c: &Vector2<f64>| c.x >= low_m.x && c.y >= low_m.y && c.x < high_m.x && c.y < high_m.y;
        let classes = self.rock_classes(smallest_m).filter(|class| class.scatter.smallest_m < largest_m);
        let rocks_of = |class: &RockClass| {
            let found = class.scatter.within(low_m, high_m).into_iter();
            let asked = found.filter(|f| f.diameter_m >= smallest_m && f.diameter_m < largest_m && inside(&f.center_m));
            asked.map(|f| class.rock(&f)).collect::<Vec<_>>()
        };
        classes.flat_map(rocks_of).collect()
    }

    /// Rocks a square metre, in the mean, of each class from the largest to the smallest, with its smallest diameter in m.
    pub fn rock_numbers_1_m2(&self) -> impl Iterator<Item = (f64, f64)> {
        self.features.rocks.iter().map(|class| (class.scatter.smallest_m, class.scatter.number_1_m2()))
    }

    /// Diameter of the largest rock that there may be, in m.
    pub fn largest_rock_m(&self) -> f64 {
        self.features.rocks.first().map_or(0.0, |class| 2.0 * class.scatter.smallest_m)
    }
}
