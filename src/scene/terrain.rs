//! Procedural terrain: fractal relief, craters and albedo, known at every place from kilometres down to centimetres.

use super::{
    CraterClass, FeatureSample, GroundBase, NoiseOctave, OctaveStrength, Photometry, RockClass, Scatter, TerrainConfig,
};
use crate::stats::random_stream;
use nalgebra::Vector2;
use rand::RngExt;
use std::sync::Arc;

/// Terrain in the site frame: z up, origin on the ground at the landing point.
#[derive(Debug, Clone, PartialEq)]
pub struct Terrain {
    pub(super) octaves: Vec<NoiseOctave>,
    pub(super) craters: Vec<CraterClass>,
    pub(super) rocks: Vec<RockClass>,
    mean_albedo: f64,
    photometry: Photometry,
    sky_light: f64,
    pub(super) height_at_origin_m: f64,
    /// What is measured of the ground; the rest of this is added to it.
    pub(super) base: Option<Arc<GroundBase>>,
}

/// The ground at one place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GroundSample {
    /// Height in m.
    pub height_m: f64,
    /// Gradient of the height by x and y.
    pub gradient: Vector2<f64>,
    /// Albedo over the mean albedo, minus 1, before clamping.
    pub albedo_change: f64,
}

/// Which details of the ground are evaluated: those at least this large, in m.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct GroundDetail {
    /// Wavelength of relief that counts in the height.
    pub height_m: f64,
    /// Wavelength of relief and albedo that counts in gradient and albedo; at least `height_m`.
    pub shade_m: f64,
    /// Smallest diameter of a class of craters or rocks.
    pub feature_m: f64,
    /// Footprint of a pixel: details near it fade as they do in a picture. 0 shows all.
    pub footprint_m: f64,
}

impl Terrain {
    /// Terrain of a configuration that [`TerrainConfig::validate`] accepts.
    pub fn new(config: &TerrainConfig, seed: u64) -> Self {
        let mut strength = OctaveStrength {
            largest_m: config.largest_wavelength_m,
            smallest_m: config.smallest_wavelength_m,
            slope_at_1_m: 0.0,
            hurst: config.hurst,
            albedo_contrast: config.albedo_contrast,
        };
        strength.slope_at_1_m = strength.slope_at_1_m_from_rms(config.rms_slope, config.slope_scale_m);
        let mut terrain = Terrain {
            octaves: NoiseOctave::planar(&strength, seed, "terrain-relief"),
            craters: crater_classes(config, seed),
            rocks: rock_classes(config, seed),
            mean_albedo: config.albedo,
            photometry: config.photometry,
            sky_light: config.sky_light,
            height_at_origin_m: 0.0,
            base: None,
        };
        terrain.height_at_origin_m = terrain.height_m(0.0, 0.0);
        terrain
    }

    /// Height of the ground in m at a place in m; 0 at the origin.
    pub fn height_m(&self, x_m: f64, y_m: f64) -> f64 {
        let all = GroundDetail { shade_m: f64::INFINITY, ..GroundDetail::default() };
        self.sample(x_m, y_m, &all).height_m
    }

    /// Gradient of the height by x and y, with every detail.
    pub fn gradient(&self, x_m: f64, y_m: f64) -> Vector2<f64> {
        self.sample(x_m, y_m, &GroundDetail::default()).gradient
    }

    /// Albedo at a place in m, with every detail.
    pub fn albedo(&self, x_m: f64, y_m: f64) -> f64 {
        self.albedo_from_change(self.sample(x_m, y_m, &GroundDetail::default()).albedo_change)
    }

    /// Albedo of a relative change, kept between 0.02 and 0.95.
    pub fn albedo_from_change(&self, albedo_change: f64) -> f64 {
        (self.mean_albedo * (1.0 + albedo_change)).clamp(0.02, 0.95)
    }

    /// The ground at a place in m with chosen details.
    pub fn sample(&self, x_m: f64, y_m: f64, detail: &GroundDetail) -> GroundSample {
        let mut features = FeatureSample::default();
        for class in self.craters(detail) {
            class.scatter.near(x_m, y_m).for_each(|f| class.add(&f, &mut features, x_m, y_m));
        }
        for class in self.rocks(detail) {
            class.scatter.near(x_m, y_m).for_each(|f| class.add(&f, &mut features, x_m, y_m));
        }
        self.relief_with(&features, x_m, y_m, detail)
    }

    /// Fractal relief with the given features on it.
    pub(super) fn relief_with(
        &self,
        features: &FeatureSample,
        x_m: f64,
        y_m: f64,
        detail: &GroundDetail,
    ) -> GroundSample {
        let flat = GroundSample { height_m: 0.0, gradient: Vector2::zeros(), albedo_change: 0.0 };
        let mut sample = self.base.as_ref().map_or(flat, |base| base.sample(x_m, y_m, detail));
        for octave in self.octaves.iter().take_while(|o| o.wavelength_m >= detail.height_m) {
            let weight = visibility(octave.wavelength_m, detail.footprint_m);
            if weight <= 0.0 {
                break;
            }
            let noise = octave.sample_planar(x_m, y_m);
            sample.height_m += octave.relief_m * noise.relief;
            if octave.wavelength_m >= detail.shade_m {
                sample.gradient += noise.relief_gradient.xy() * (octave.relief_m * weight);
                sample.albedo_change += octave.albedo * noise.albedo * weight;
            }
        }
        // In this order, so that the origin comes out at exactly 0.
        sample.height_m = sample.height_m + features.height_m - self.height_at_origin_m;
        sample.gradient += features.gradient;
        sample.albedo_change += features.albedo;
        sample
    }

    /// Classes of craters that a choice of details shows.
    pub(super) fn craters(&self, detail: &GroundDetail) -> impl Iterator<Item = &CraterClass> {
        let smallest_m = detail.feature_m;
        self.craters.iter().take_while(move |c| c.scatter.smallest_m >= smallest_m)
    }

    /// Classes of rocks that a choice of details shows.
    pub(super) fn rocks(&self, detail: &GroundDetail) -> impl Iterator<Item = &RockClass> {
        let smallest_m = detail.feature_m;
        self.rocks.iter().take_while(move |r| r.scatter.smallest_m >= smallest_m)
    }

    /// Octaves of relief and albedo, the largest first.
    pub fn octaves(&self) -> &[NoiseOctave] {
        &self.octaves
    }

    /// Mean albedo.
    pub fn mean_albedo(&self) -> f64 {
        self.mean_albedo
    }

    /// How the ground scatters sunlight.
    pub fn photometry(&self) -> &Photometry {
        &self.photometry
    }

    /// Radiance of the sky over that of a sunlit white surface.
    pub fn sky_light(&self) -> f64 {
        self.sky_light
    }
}

fn visibility(wavelength_m: f64, footprint_m: f64) -> f64 {
    if footprint_m > 0.0 { NoiseOctave::visibility(wavelength_m, footprint_m) } else { 1.0 }
}

fn crater_classes(config: &TerrainConfig, seed: u64) -> Vec<CraterClass> {
    let diameters_m = [config.smallest_crater_m, config.largest_crater_m];
    Scatter::classes(diameters_m, config.crater_density, config.crater_exponent, seeds(seed, "terrain-craters"))
        .into_iter()
        .map(|scatter| CraterClass {
            scatter,
            depth_ratio: config.crater_depth_ratio,
            site_slope: config.site_slope,
            albedo_contrast: 3.0 * config.albedo_contrast,
        })
        .collect()
}

fn rock_classes(config: &TerrainConfig, seed: u64) -> Vec<RockClass> {
    let lengths_m = [config.smallest_rock_m, config.largest_rock_m];
    Scatter::classes(lengths_m, config.rock_density, config.rock_exponent, seeds(seed, "terrain-rocks"))
        .into_iter()
        .map(|scatter| RockClass {
            scatter,
            site_slope: config.site_slope,
            albedo_contrast: 3.0 * config.albedo_contrast,
        })
        .collect()
}

fn seeds(seed: u64, purpose: &'static str) -> impl FnMut(u64) -> [u32; 2] {
    move |index| {
        let mut random = random_stream(seed, purpose, index);
        [random.random(), random.random()]
    }
}
