//! Scatters features over the plane by hashing, so that every place can be evaluated on its own.

use super::sizes::Sizes;
use crate::scene::noise::{NoiseOctave, pcg2d};
use nalgebra::Vector2;

/// Features that a cell of the grid can hold.
const FEATURES_PER_CELL: u32 = 2;

/// A grid of hashed cells, each holding up to two features of one octave of diameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Scatter {
    /// Smallest diameter in m; the largest is twice that.
    pub smallest_m: f64,
    /// Mean probability of each feature that a cell can hold.
    pub probability: f64,
    /// Diameters over the smallest one, as the octave's share of smaller features rises from 0 to 1.
    pub(super) sizes: Sizes,
    /// Seeds of the hash.
    pub seed: [u32; 2],
    /// Where features gather, if not evenly everywhere.
    pub(super) patches: Option<Patches>,
}

/// Uneven density: the probability is multiplied by 1 + `strength` times a noise field, where that is positive.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Patches {
    pub field: NoiseOctave,
    pub strength: f64,
}

/// Where a feature is and what is random about it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Feature {
    /// Centre in the site frame, m.
    pub center_m: Vector2<f64>,
    /// Diameter in m.
    pub diameter_m: f64,
    /// Independent random numbers, 0 to 1.
    pub random: [f64; 4],
}

impl Scatter {
    /// Reach of a feature in radii: the largest one reaches half a cell, so that the four nearest cells suffice.
    pub const REACH_RADII: f64 = 2.0;

    /// The same grid, unevenly filled.
    pub(super) fn patchy(self, patches: &Patches) -> Scatter {
        Scatter { patches: Some(patches.clone()), ..self }
    }

    /// Grids of one octave of diameters each, the largest first, for features of which N(>D) ~ D^-`exponent`.
    /// `probability` is that of the smallest class.
    pub fn classes(
        [smallest_m, largest_m]: [f64; 2],
        probability: f64,
        exponent: f64,
        mut seeds: impl FnMut(u64) -> [u32; 2],
    ) -> Vec<Scatter> {
        octaves_m(smallest_m, largest_m)
            .zip(0..)
            .map(|(class_m, index)| Scatter {
                smallest_m: class_m,
                // Cells grow with the diameter, so that a class's share of the ground is constant for b = 2.
                probability: (probability * (class_m / smallest_m).powf(2.0 - exponent)).min(1.0),
                sizes: Sizes::of_power_law(exponent),
                seed: seeds(index),
                patches: None,
            })
            .collect()
    }

    /// Grids of one octave of diameters each, the largest first, for features of which a square metre holds
    /// `density_1_m2(D) dD/D` between the diameters D and D + dD.
    pub fn classes_of_density(
        [smallest_m, largest_m]: [f64; 2],
        density_1_m2: impl Fn(f64) -> f64,
        mut seeds: impl FnMut(u64) -> [u32; 2],
    ) -> Vec<Scatter> {
        octaves_m(smallest_m, largest_m)
            .zip(0..)
            .map(|(class_m, index)| {
                let (sizes, number_1_m2) = Sizes::of_density(class_m, &density_1_m2);
                let cell_m = Scatter::cell_of_m(class_m);
                let probability = (number_1_m2 * cell_m * cell_m / f64::from(FEATURES_PER_CELL)).min(1.0);
                Scatter { smallest_m: class_m, probability, sizes, seed: seeds(index), patches: None }
            })
            .collect()
    }

    /// Mean number of features a square metre.
    pub(in crate::scene::terrain) fn number_1_m2(&self) -> f64 {
        f64::from(FEATURES_PER_CELL) * self.probability / Scatter::cell_of_m(self.smallest_m).powi(2)
    }

    /// Features that may reach a place (m), in a fixed order.
    pub fn near(&self, x_m: f64, y_m: f64) -> impl Iterator<Item = Feature> + '_ {
        let cell_m = Scatter::cell_of_m(self.smallest_m);
        let (first_x, first_y) = ((x_m / cell_m - 0.5).floor() as i64, (y_m / cell_m - 0.5).floor() as i64);
        (0..4 * FEATURES_PER_CELL).filter_map(move |k| {
            let (cell, which) = (i64::from(k & 3), k >> 2);
            self.feature([first_x + (cell & 1), first_y + (cell >> 1)], which, cell_m)
        })
    }

    /// Features that may reach a rectangle (corners in m), in the order in which [`Scatter::near`] gives them.
    pub fn within(&self, low_m: &Vector2<f64>, high_m: &Vector2<f64>) -> Vec<Feature> {
        let cell_m = Scatter::cell_of_m(self.smallest_m);
        let first = low_m.map(|c| (c / cell_m - 0.5).floor() as i64);
        let last = high_m.map(|c| (c / cell_m + 0.5).floor() as i64);
        let mut found = Vec::new();
        for which in 0..FEATURES_PER_CELL {
            for y in first.y..=last.y {
                found.extend((first.x..=last.x).filter_map(|x| self.feature([x, y], which, cell_m)));
            }
        }
        found.retain(|f| {
            let nearest = f.center_m.sup(low_m).inf(high_m);
            (f.center_m - nearest).norm() < 0.5 * f.diameter_m * Scatter::REACH_RADII
        });
        found
    }

    /// Edge of a cell in m of the class from `smallest_m` on.
    fn cell_of_m(smallest_m: f64) -> f64 {
        2.0 * Scatter::REACH_RADII * smallest_m
    }

    fn feature(&self, cell: [i64; 2], which: u32, cell_m: f64) -> Option<Feature> {
        let unit = |h: u32| f64::from(h) / 65536.0;
        let salt = which.wrapping_mul(0x9e37_79b9);
        let first = pcg2d(cell[0] as u32 ^ self.seed[0], cell[1] as u32 ^ self.seed[1] ^ salt);
        let most = self.patches.as_ref().map_or(1.0, |p| 1.0 + p.strength);
        let chance = unit(first[0] & 0xffff);
        if chance >= self.probability * most {
            return None;
        }
        let place = Vector2::new(unit(first[1] & 0xffff), unit(first[1] >> 16));
        let center_m = (Vector2::new(cell[0] as f64, cell[1] as f64) + place) * cell_m;
        if self.patches.as_ref().is_some_and(|p| chance >= self.probability * p.density(&center_m)) {
            return None;
        }
        let second = pcg2d(first[0], first[1]);
        let third = pcg2d(second[0], second[1]);
        Some(Feature {
            center_m,
            diameter_m: self.smallest_m * self.sizes.at(unit(second[0] & 0xffff)),
            random: [unit(first[0] >> 16), unit(second[1] & 0xffff), unit(second[1] >> 16), unit(third[0] >> 16)],
        })
    }
}

impl Patches {
    fn density(&self, center_m: &Vector2<f64>) -> f64 {
        (1.0 + self.strength * self.field.sample_planar(center_m.x, center_m.y).relief).max(0.0)
    }
}

/// Smallest diameters of octaves that end at `largest_m`, the largest first.
fn octaves_m(smallest_m: f64, largest_m: f64) -> impl Iterator<Item = f64> {
    std::iter::successors(Some(0.5 * largest_m), |d| Some(0.5 * d)).take_while(move |d| *d >= 0.999 * smallest_m)
}
