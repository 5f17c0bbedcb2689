//! Procedural terrain: fractal relief, craters and albedo, known at every place from kilometres down to centimetres.

use super::config::TerrainConfig;
use super::features::{CraterClass, HummockClass, RippleClass, Softened, TerrainFeatures, UnitClass};
use super::measured_base::GroundBase;
use super::relief::{FeatureSample, GroundDetail, GroundSample, OctaveSource, OctaveSums};
use crate::scene::noise::{NoiseOctave, NoiseTable, OctaveStrength};
use crate::scene::photometry::Photometry;
use nalgebra::Vector2;
use std::sync::Arc;

/// Terrain in the site frame: z up, origin on the ground at the landing point.
#[derive(Debug, Clone, PartialEq)]
pub struct Terrain {
    pub(super) octaves: Vec<NoiseOctave>,
    pub(super) features: TerrainFeatures,
    mean_albedo: f64,
    photometry: Photometry,
    sky_light: f64,
    pub(super) height_at_origin_m: f64,
    /// What is measured of the ground; the rest of this is added to it.
    pub(super) base: Option<Arc<GroundBase>>,
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
        let octaves = NoiseOctave::planar(&strength, seed, "terrain-relief");
        let mut terrain = Terrain {
            features: TerrainFeatures::new(config, &octaves, seed),
            octaves,
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
        let at = Vector2::new(x_m, y_m);
        for class in self.craters(detail) {
            let shown = |f| Softened::new(class.crater(&f), detail.feature_m);
            class.scatter.near(x_m, y_m).for_each(|f| shown(f).add_to(&mut features, &at));
        }
        for class in self.hummocks(detail) {
            let shown = |f| Softened::new(class.hummock(&f), detail.feature_m);
            class.scatter.near(x_m, y_m).for_each(|f| shown(f).add_to(&mut features, &at));
        }
        self.ripples(detail).for_each(|class| class.add_to(&mut features, &at, ([None, None], detail)));
        let ground = OctaveSums::new(&self.octave_source(&[]), &at, detail);
        self.units(detail).for_each(|class| class.add_to(&mut features, &at, (None, detail), &ground));
        let mut tallest = FeatureSample::default();
        for class in self.rock_classes(detail.rock_m) {
            let rocks = class.scatter.near(x_m, y_m).filter(|f| f.diameter_m >= detail.rock_m);
            rocks.for_each(|f| class.rock(&f).raise(&mut tallest, &at));
        }
        self.with_features(&ground, &features).under(&tallest)
    }

    /// What the fractal relief is added up of; `tables` are the lattices of its first octaves.
    pub(super) fn octave_source<'a>(&'a self, tables: &'a [Option<NoiseTable>]) -> OctaveSource<'a> {
        OctaveSource { octaves: &self.octaves, base: self.base.as_deref(), tables }
    }

    /// The fractal relief with features on it.
    pub(super) fn with_features(&self, ground: &OctaveSums, features: &FeatureSample) -> GroundSample {
        GroundSample {
            // In this order, so that the origin comes out at exactly 0.
            height_m: ground.relief().height_m + features.height_m - self.height_at_origin_m,
            gradient: ground.relief().gradient + features.gradient,
            albedo_change: ground.relief().albedo_change + features.albedo,
        }
    }

    /// Classes of craters that a choice of details shows: down to half the smallest diameter, for their rims' sake.
    pub(super) fn craters(&self, detail: &GroundDetail) -> impl Iterator<Item = &CraterClass> {
        let smallest_m = 0.5 * detail.feature_m;
        self.features.craters.iter().take_while(move |c| c.scatter.smallest_m >= smallest_m)
    }

    /// Classes of hummocks that a choice of details shows.
    pub(super) fn hummocks(&self, detail: &GroundDetail) -> impl Iterator<Item = &HummockClass> {
        let smallest_m = 0.5 * detail.feature_m;
        self.features.hummocks.iter().take_while(move |h| h.scatter.smallest_m >= smallest_m)
    }

    /// Classes of ripples that a choice of details shows: each wave needs a little more than the smallest features.
    pub(super) fn ripples(&self, detail: &GroundDetail) -> impl Iterator<Item = &RippleClass> {
        let shortest_m = 1.25 * detail.feature_m;
        self.features.ripples.iter().take_while(move |r| r.wavelength_m >= shortest_m)
    }

    /// Classes of geological units that a choice of details shows.
    pub(super) fn units(&self, detail: &GroundDetail) -> impl Iterator<Item = &UnitClass> {
        let smallest_m = UnitClass::SMALLEST_SHOWN * detail.feature_m;
        self.features.units.iter().take_while(move |u| u.field.wavelength_m >= smallest_m)
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
