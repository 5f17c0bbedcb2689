//! What the octaves of fractal ground add up to at one place: relief, albedo, and how far contacts are displaced.

use super::ground_sample::{GroundDetail, GroundSample};
use crate::scene::noise::{NOISE_2D_STEEPEST, NoiseOctave, NoiseTable};
use crate::scene::terrain::measured_base::GroundBase;
use nalgebra::Vector2;

fn visibility(wavelength_m: f64, footprint_m: f64) -> f64 {
    if footprint_m > 0.0 { NoiseOctave::visibility(wavelength_m, footprint_m) } else { 1.0 }
}

/// No terrain has more octaves: halvings from the largest to the smallest wavelength that a configuration may ask for.
const MOST_OCTAVES: usize = 32;

/// Size of the evaluated details over the wavelength of the finest octave that displaces contacts.
const FINEST_DISPLACING: f64 = 8.0;

/// Displacement of a contact by an octave, over its wavelength and albedo field.
pub const DISPLACEMENT: f64 = 0.5;

/// What octaves are added up of.
#[derive(Debug, Clone, Copy)]
pub struct OctaveSource<'a> {
    /// The octaves, the largest first.
    pub octaves: &'a [NoiseOctave],
    /// What is measured of the ground below them.
    pub base: Option<&'a GroundBase>,
    /// Lattices of the first octaves, looked up once.
    pub tables: &'a [Option<NoiseTable>],
}

/// What the octaves of a terrain add up to at one place.
#[derive(Debug)]
pub struct OctaveSums<'a> {
    relief: GroundSample,
    octaves: &'a [NoiseOctave],
    tables: &'a [Option<NoiseTable>],
    at: Vector2<f64>,
    /// Octaves in the relief.
    count: usize,
    /// Octaves that displace contacts: more than those in the relief, or contacts would move as finer relief is evaluated.
    displacing: usize,
    displacement_m: [f64; MOST_OCTAVES],
}

impl<'a> OctaveSums<'a> {
    /// Sums at a place (m).
    pub fn new(source: &OctaveSource<'a>, at: &Vector2<f64>, detail: &GroundDetail) -> Self {
        let flat = GroundSample { height_m: 0.0, gradient: Vector2::zeros(), albedo_change: 0.0 };
        let mut sums = OctaveSums {
            relief: source.base.map_or(flat, |base| base.sample(at.x, at.y, detail)),
            octaves: source.octaves,
            tables: source.tables,
            at: *at,
            count: 0,
            displacing: source.octaves.partition_point(|o| o.wavelength_m * FINEST_DISPLACING >= detail.height_m),
            displacement_m: [0.0; MOST_OCTAVES],
        };
        for octave in source.octaves.iter().take(MOST_OCTAVES) {
            let weight = visibility(octave.wavelength_m, detail.footprint_m);
            if octave.wavelength_m < detail.height_m || weight <= 0.0 {
                break;
            }
            sums.add(octave, weight, detail);
        }
        sums
    }

    fn add(&mut self, octave: &NoiseOctave, weight: f64, detail: &GroundDetail) {
        let table = self.table(self.count);
        let [relief, albedo] = if octave.wavelength_m >= detail.shade_m {
            let noise = octave.sample_planar_from(table, self.at.x, self.at.y);
            self.relief.gradient += noise.relief_gradient.xy() * (octave.relief_m * weight);
            self.relief.albedo_change += octave.albedo * noise.albedo * weight;
            [noise.relief, noise.albedo]
        } else {
            octave.values_planar_from(table, self.at.x, self.at.y)
        };
        self.relief.height_m += octave.relief_m * relief;
        self.displacement_m[self.count] = DISPLACEMENT * octave.wavelength_m * albedo;
        self.count += 1;
    }

    /// How much the displacement of contacts by the octaves from `first` on can change within a distance, in m.
    pub fn displacement_change_m(&self, first: usize, within_m: f64) -> f64 {
        let octaves = self.octaves.iter().take(self.displacing).skip(first);
        octaves.map(|o| DISPLACEMENT * (NOISE_2D_STEEPEST * within_m).min(2.0 * o.wavelength_m)).sum()
    }

    fn table(&self, index: usize) -> Option<&'a NoiseTable> {
        self.tables.get(index).and_then(Option::as_ref)
    }

    /// The relief and albedo of the octaves that are evaluated, on the measured base.
    pub fn relief(&self) -> &GroundSample {
        &self.relief
    }

    /// The place, m.
    pub fn at(&self) -> &Vector2<f64> {
        &self.at
    }

    /// Displacement in m of contacts by the octaves from `first` on, those outside the relief left out, and the most that
    /// these can add.
    pub fn coarse_displacement_m(&self, first: usize) -> (f64, f64) {
        let coarse_m = self.displacement_m[first.min(self.count)..self.count].iter().sum();
        (coarse_m, self.fine_octaves(first).map(|o| DISPLACEMENT * o.wavelength_m).sum())
    }

    /// Displacement in m of contacts by the octaves from `first` on that are outside the relief.
    pub fn fine_displacement_m(&self, first: usize) -> f64 {
        let value = |o: &NoiseOctave| o.values_planar_from(None, self.at.x, self.at.y)[1];
        self.fine_octaves(first).map(|o| DISPLACEMENT * o.wavelength_m * value(o)).sum()
    }

    fn fine_octaves(&self, first: usize) -> impl Iterator<Item = &NoiseOctave> {
        self.octaves.iter().take(self.displacing).skip(first.max(self.count))
    }

    /// Displacement in m of contacts by the octaves from `first` on.
    pub fn displacement_m(&self, first: usize) -> f64 {
        self.coarse_displacement_m(first).0 + self.fine_displacement_m(first)
    }

    /// Gradient of [`OctaveSums::displacement_m`] by the octaves in the relief.
    pub fn displacement_gradient(&self, first: usize) -> Vector2<f64> {
        let octaves = self.octaves.iter().enumerate().take(self.count).skip(first);
        octaves
            .map(|(index, o)| {
                o.albedo_gradient_from(self.table(index), self.at.x, self.at.y) * (DISPLACEMENT * o.wavelength_m)
            })
            .sum()
    }
}
