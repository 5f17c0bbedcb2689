//! Scatters features over the plane by hashing, so that every place can be evaluated on its own.

use super::noise::pcg2d;
use nalgebra::Vector2;

/// Features that a cell of the grid can hold.
const FEATURES_PER_CELL: u32 = 2;

/// A grid of hashed cells, each holding up to two features of one octave of diameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scatter {
    /// Smallest diameter in m; the largest is twice that.
    pub smallest_m: f64,
    /// Probability of each feature that a cell can hold.
    pub probability: f64,
    /// Exponent b of the number of features larger than a diameter, N(>D) ~ D^-b.
    pub exponent: f64,
    /// Seeds of the hash.
    pub seed: [u32; 2],
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

    /// Grids of one octave of diameters each, the largest first. `probability` is that of the smallest class.
    pub fn classes(
        [smallest_m, largest_m]: [f64; 2],
        probability: f64,
        exponent: f64,
        mut seeds: impl FnMut(u64) -> [u32; 2],
    ) -> Vec<Scatter> {
        std::iter::successors(Some(0.5 * largest_m), |d| Some(0.5 * d))
            .take_while(|d| *d >= 0.999 * smallest_m)
            .zip(0..)
            .map(|(class_m, index)| Scatter {
                smallest_m: class_m,
                // Cells grow with the diameter, so that a class's share of the ground is constant for b = 2.
                probability: (probability * (class_m / smallest_m).powf(2.0 - exponent)).min(1.0),
                exponent,
                seed: seeds(index),
            })
            .collect()
    }

    /// Features that may reach a place (m), in a fixed order.
    pub fn near(&self, x_m: f64, y_m: f64) -> impl Iterator<Item = Feature> + '_ {
        let cell_m = 2.0 * Scatter::REACH_RADII * self.smallest_m;
        let (first_x, first_y) = ((x_m / cell_m - 0.5).floor() as i64, (y_m / cell_m - 0.5).floor() as i64);
        (0..4 * FEATURES_PER_CELL).filter_map(move |k| {
            let (cell, which) = (i64::from(k & 3), k >> 2);
            self.feature([first_x + (cell & 1), first_y + (cell >> 1)], which, cell_m)
        })
    }

    /// Features that may reach a rectangle (corners in m), in the order in which [`Scatter::near`] gives them.
    pub fn within(&self, low_m: &Vector2<f64>, high_m: &Vector2<f64>) -> Vec<Feature> {
        let cell_m = 2.0 * Scatter::REACH_RADII * self.smallest_m;
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

    fn feature(&self, cell: [i64; 2], which: u32, cell_m: f64) -> Option<Feature> {
        let unit = |h: u32| f64::from(h) / 65536.0;
        let salt = which.wrapping_mul(0x9e37_79b9);
        let first = pcg2d(cell[0] as u32 ^ self.seed[0], cell[1] as u32 ^ self.seed[1] ^ salt);
        if unit(first[0] & 0xffff) >= self.probability {
            return None;
        }
        let second = pcg2d(first[0], first[1]);
        let third = pcg2d(second[0], second[1]);
        let place = Vector2::new(unit(first[1] & 0xffff), unit(first[1] >> 16));
        // Inverse of the power law inside one octave of diameters.
        let share = 1.0 - unit(second[0] & 0xffff) * (1.0 - 0.5_f64.powf(self.exponent));
        Some(Feature {
            center_m: (Vector2::new(cell[0] as f64, cell[1] as f64) + place) * cell_m,
            diameter_m: self.smallest_m * share.powf(-1.0 / self.exponent),
            random: [unit(first[0] >> 16), unit(second[1] & 0xffff), unit(second[1] >> 16), unit(third[0] >> 16)],
        })
    }
}
