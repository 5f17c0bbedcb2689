//! Classes of features that a configuration asks for.

use super::crater::CraterClass;
use super::hummock::HummockClass;
use super::ripple::RippleClass;
use super::rock::{RockClass, rock_density_1_m2};
use super::scatter::{Patches, Scatter};
use super::unit::{HALF_WIDTH, LARGEST_DISPLACING, UnitClass};
use crate::scene::noise::NoiseOctave;
use crate::scene::terrain::config::TerrainConfig;
use crate::stats::random_stream;
use nalgebra::Vector2;
use rand::RngExt;
use statrs::distribution::{ContinuousCDF, Normal};

/// Everything on the fractal relief, each kind from the largest class to the smallest.
#[derive(Debug, Clone, PartialEq)]
pub struct TerrainFeatures {
    pub craters: Vec<CraterClass>,
    pub rocks: Vec<RockClass>,
    pub hummocks: Vec<HummockClass>,
    pub ripples: Vec<RippleClass>,
    pub units: Vec<UnitClass>,
}

/// Wavelength over that of the next smaller class of units.
const UNIT_STEP: f64 = 4.0;
/// Contrast of a class of units over that of the next larger one.
const UNIT_CONTRAST_STEP: f64 = 0.8;
/// Contrast of all but the two largest classes, over what the step makes of it.
const SMALL_UNIT_CONTRAST: f64 = 0.35;
/// How much darker the faces of scarps are, over the contrast of units.
const FACE_CONTRAST: f64 = 0.6;
/// Half-width of a contact without a scarp over the wavelength of its units.
const SOFT_CONTACT: f64 = 0.2;
/// Wavelength over that of the next smaller class of ripples.
const RIPPLE_STEP: f64 = 3.7;
/// Wavelength of the patches of ground on which craters last, m.
const CRATER_PATCH_M: f64 = 800.0;
/// How strongly craters gather.
const CRATER_PATCH_STRENGTH: f64 = 4.0;
/// Wavelength of the patches in which hummocks crowd, m.
const HUMMOCK_PATCH_M: f64 = 600.0;
/// How strongly hummocks crowd.
const HUMMOCK_PATCH_STRENGTH: f64 = 6.0;
/// Wavelength of the patches in which rocks gather, m.
const ROCK_PATCH_M: f64 = 55.0;
/// How strongly rocks gather.
const ROCK_PATCH_STRENGTH: f64 = 3.0;
/// Spread of the directions of ripples of different wavelengths, rad.
const RIPPLE_SPREAD_RAD: f64 = 0.5;

impl TerrainFeatures {
    pub fn new(config: &TerrainConfig, octaves: &[NoiseOctave], seed: u64) -> Self {
        TerrainFeatures {
            craters: craters(config, seed),
            rocks: rocks(config, seed),
            hummocks: hummocks(config, seed),
            ripples: ripples(config, seed),
            units: units(config, octaves, seed),
        }
    }
}

impl TerrainFeatures {
    /// Leaves to a measured base what is larger than its details: `[relief_m, albedo_m]` are the largest wavelengths and
    /// diameters of relief and of albedo that remain; `octaves` are those of the terrain on the base.
    pub fn on_base(&mut self, [relief_m, albedo_m]: [f64; 2], octaves: &[NoiseOctave]) {
        self.craters.retain(|c| c.scatter.smallest_m <= relief_m);
        self.rocks.retain(|r| r.scatter.smallest_m <= relief_m);
        self.hummocks.retain(|h| h.scatter.smallest_m <= relief_m);
        self.ripples.retain(|r| r.wavelength_m <= relief_m);
        self.units.retain(|u| u.field.wavelength_m <= relief_m);
        let shown = |size_m: f64| f64::from(size_m <= albedo_m);
        self.craters.iter_mut().for_each(|c| c.albedo_contrast *= shown(c.scatter.smallest_m));
        self.rocks.iter_mut().for_each(|r| r.albedo_contrast *= shown(r.scatter.smallest_m));
        self.hummocks.iter_mut().for_each(|h| h.albedo_contrast *= shown(h.scatter.smallest_m));
        self.ripples.iter_mut().for_each(|r| r.albedo_contrast *= shown(r.wavelength_m));
        for unit in &mut self.units {
            let is_shown = shown(unit.field.wavelength_m);
            unit.contrast *= is_shown;
            unit.face_contrast *= is_shown;
            unit.first_octave = first_displacing(unit.field.wavelength_m, octaves);
        }
    }
}

/// First octave that displaces the contacts of units of a wavelength.
fn first_displacing(wavelength_m: f64, octaves: &[NoiseOctave]) -> usize {
    octaves.partition_point(|o| o.wavelength_m > LARGEST_DISPLACING * wavelength_m)
}

fn craters(config: &TerrainConfig, seed: u64) -> Vec<CraterClass> {
    let diameters_m = [config.smallest_crater_m, config.largest_crater_m];
    let patches = Patches {
        field: NoiseOctave::field(CRATER_PATCH_M, seed, "terrain-crater-patches", 0),
        strength: CRATER_PATCH_STRENGTH,
    };
    Scatter::classes(diameters_m, config.crater_density, config.crater_exponent, seeds(seed, "terrain-craters"))
        .into_iter()
        .map(|scatter| CraterClass {
            scatter: scatter.patchy(&patches),
            depth_ratio: config.crater_depth_ratio,
            site_slope: config.site_slope,
            albedo_contrast: config.unit_contrast,
        })
        .collect()
}

fn rocks(config: &TerrainConfig, seed: u64) -> Vec<RockClass> {
    if config.rock_abundance <= 0.0 {
        return Vec::new();
    }
    let diameters_m = [config.smallest_rock_m, config.largest_rock_m];
    let density_1_m2 = |diameter_m| rock_density_1_m2(config.rock_abundance, diameter_m);
    let patches = Patches {
        field: NoiseOctave::field(ROCK_PATCH_M, seed, "terrain-rock-patches", 0),
        strength: ROCK_PATCH_STRENGTH,
    };
    Scatter::classes_of_density(diameters_m, density_1_m2, seeds(seed, "terrain-rocks"))
        .into_iter()
        .map(|scatter| RockClass {
            scatter: scatter.patchy(&patches),
            site_slope: config.site_slope,
            albedo_contrast: config.unit_contrast,
        })
        .collect()
}

fn hummocks(config: &TerrainConfig, seed: u64) -> Vec<HummockClass> {
    let diameters_m = [config.smallest_hummock_m, config.largest_hummock_m];
    let patches = Patches {
        field: NoiseOctave::field(HUMMOCK_PATCH_M, seed, "terrain-hummock-patches", 0),
        strength: HUMMOCK_PATCH_STRENGTH,
    };
    // The same share of the ground for each octave of diameters.
    Scatter::classes(diameters_m, config.hummock_density, 2.0, seeds(seed, "terrain-hummocks"))
        .into_iter()
        .map(|scatter| HummockClass {
            scatter: scatter.patchy(&patches),
            height_ratio: config.hummock_height_ratio,
            site_slope: config.site_slope,
            albedo_contrast: 0.5 * config.unit_contrast,
        })
        .collect()
}

fn ripples(config: &TerrainConfig, seed: u64) -> Vec<RippleClass> {
    if config.ripple_cover <= 0.0 {
        return Vec::new();
    }
    // R.m.s. of the sum of fields that the cover is cut from, each with the r.m.s. of the noise.
    let spread = crate::scene::noise::NOISE_2D_RMS * 1.0_f64.hypot(RippleClass::COVER_BY_BEND);
    let least_cover = Normal::new(0.0, spread).expect("a positive spread").inverse_cdf(1.0 - config.ripple_cover);
    let wind_rad = random_stream(seed, "terrain-wind", 0).random_range(0.0..std::f64::consts::TAU);
    steps(config.largest_ripple_m, config.smallest_ripple_m, RIPPLE_STEP)
        .zip(0..)
        .map(|(wavelength_m, index)| {
            let turn = random_stream(seed, "terrain-wind", index + 1).random_range(-1.0..1.0);
            let (sin, cos) = (wind_rad + RIPPLE_SPREAD_RAD * turn).sin_cos();
            let field =
                |wavelengths: f64, purpose| NoiseOctave::field(wavelengths * wavelength_m, seed, purpose, index);
            RippleClass {
                wavelength_m,
                height_m: config.ripple_height_ratio * wavelength_m,
                site_slope: config.site_slope,
                across: Vector2::new(cos, sin),
                cover: field(RippleClass::COVER_WAVELENGTHS, "terrain-sand"),
                bend: field(RippleClass::BEND_WAVELENGTHS, "terrain-ripples"),
                least_cover,
                albedo_contrast: 0.5 * config.unit_contrast,
            }
        })
        .collect()
}

/// Scarps and drifts of dust with soft edges take turns; the smaller the units, the less they differ.
fn units(config: &TerrainConfig, octaves: &[NoiseOctave], seed: u64) -> Vec<UnitClass> {
    if config.unit_contrast <= 0.0 && config.scarp_ratio <= 0.0 {
        return Vec::new();
    }
    let unit = |(wavelength_m, index): (f64, u64)| {
        let is_scarp = index % 2 == 0;
        let scarp_m = if is_scarp { config.scarp_ratio * wavelength_m } else { 0.0 };
        let faint = if index > 1 { SMALL_UNIT_CONTRAST } else { 1.0 };
        UnitClass {
            field: NoiseOctave::field(wavelength_m, seed, "terrain-units", index),
            first_octave: first_displacing(wavelength_m, octaves),
            scarp_m,
            half_width_m: if is_scarp { HALF_WIDTH * scarp_m } else { SOFT_CONTACT * wavelength_m },
            site_slope: config.site_slope,
            contrast: config.unit_contrast * faint * UNIT_CONTRAST_STEP.powi(index as i32),
            face_contrast: if is_scarp { -FACE_CONTRAST * config.unit_contrast } else { 0.0 },
        }
    };
    steps(config.largest_unit_m, config.smallest_unit_m, UNIT_STEP).zip(0..).map(unit).collect()
}

/// From the largest down to the smallest by a factor.
fn steps(largest_m: f64, smallest_m: f64, step: f64) -> impl Iterator<Item = f64> {
    std::iter::successors(Some(largest_m), move |w| Some(w / step)).take_while(move |w| *w >= 0.999 * smallest_m)
}

fn seeds(seed: u64, purpose: &'static str) -> impl FnMut(u64) -> [u32; 2] {
    move |index| {
        let mut random = random_stream(seed, purpose, index);
        [random.random(), random.random()]
    }
}
