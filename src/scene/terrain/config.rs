//! Parameters of procedural terrain.

use crate::scene::photometry::Photometry;
use crate::settings::{OutOfRange, limits};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Procedural terrain around the landing point.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct TerrainConfig {
    /// Largest wavelength of the fractal relief in m, 1 to 100000 (default 6000).
    pub largest_wavelength_m: f64,
    /// Smallest wavelength of the fractal relief in m, 0.001 to 1000 (default 0.02).
    pub smallest_wavelength_m: f64,
    /// Hurst exponent of the relief, 0 to 1 (default 0.8).
    pub hurst: f64,
    /// R.m.s. slope of the relief of all wavelengths down to `slope_scale_m`, rise over run, 0 to 1 (default 0.075).
    pub rms_slope: f64,
    /// Wavelength in m that `rms_slope` is stated at, 0.001 to 100000 (default 1).
    pub slope_scale_m: f64,
    /// Mean albedo, 0 to 1 (default 0.2).
    pub albedo: f64,
    /// How the ground scatters sunlight (default lunar-Lambert with weight 0.6).
    pub photometry: Photometry,
    /// Radiance of the sky over that of a sunlit white surface, 0 to 1 (default 0.15, a hazy Martian sky).
    pub sky_light: f64,
    /// Relative r.m.s. variation of the albedo, per octave, 0 to 0.3 (default 0.03); less at wavelengths of kilometres.
    pub albedo_contrast: f64,
    /// Probability of each crater that a cell of the crater grid can hold, for the smallest craters, 0 (none) to 1 (default
    /// 0.45).
    pub crater_density: f64,
    /// Smallest crater diameter in m, 0.01 to 10000 (default 0.3).
    pub smallest_crater_m: f64,
    /// Largest crater diameter in m, 0.01 to 10000 (default 800).
    pub largest_crater_m: f64,
    /// Exponent b of the number of craters larger than a diameter, N(>D) ~ D^-b, 0.5 to 5 (default 1.85).
    pub crater_exponent: f64,
    /// Depth over diameter of a fresh crater, 0 to 0.4 (default 0.2).
    pub crater_depth_ratio: f64,
    /// Total abundance k of rocks: the share of the ground that rocks of all sizes cover by Golombek's law, 0 (none) to
    /// 0.4 (default 0.05).
    pub rock_abundance: f64,
    /// Smallest rock in m, 0.01 to 100 (default 0.06).
    pub smallest_rock_m: f64,
    /// Largest rock in m, 0.01 to 100 (default 4).
    pub largest_rock_m: f64,
    /// Mean probability of each hummock that a cell of the hummock grid can hold, 0 (none) to 1 (default 0.5); they crowd in
    /// patches.
    pub hummock_density: f64,
    /// Smallest hummock in m, 0.1 to 10000 (default 2).
    pub smallest_hummock_m: f64,
    /// Largest hummock in m, 0.1 to 10000 (default 256).
    pub largest_hummock_m: f64,
    /// Height of the highest hummocks over their diameter, 0 to 0.3 (default 0.08).
    pub hummock_height_ratio: f64,
    /// Share of the ground under ripples of each size, 0 (none) to 1 (default 0.3).
    pub ripple_cover: f64,
    /// Largest distance between crests of ripples in m, 0.05 to 1000 (default 28).
    pub largest_ripple_m: f64,
    /// Smallest distance between crests of ripples in m, 0.05 to 1000 (default 0.5).
    pub smallest_ripple_m: f64,
    /// Height of ripples over the distance between crests, 0 to 0.15 (default 0.07).
    pub ripple_height_ratio: f64,
    /// Relative difference of the albedo between geological units, 0 to 1 (default 0.51).
    pub unit_contrast: f64,
    /// Wavelength in m of the largest pattern of geological units, 1 to 100000 (default 3500).
    pub largest_unit_m: f64,
    /// Wavelength in m of the smallest pattern of geological units, 1 to 100000 (default 10).
    pub smallest_unit_m: f64,
    /// Height of the scarp at the edge of a unit over the wavelength of its pattern, 0 to 0.05 (default 0.007).
    pub scarp_ratio: f64,
    /// No crater is deeper, no rock, hummock, ripple or scarp higher than this times its distance from the landing
    /// point, 0 to 1 (default 0.05).
    pub site_slope: f64,
}

impl Default for TerrainConfig {
    fn default() -> Self {
        TerrainConfig {
            largest_wavelength_m: 6000.0,
            smallest_wavelength_m: 0.02,
            hurst: 0.8,
            rms_slope: 0.075,
            slope_scale_m: 1.0,
            albedo: 0.2,
            photometry: Photometry::default(),
            sky_light: 0.15,
            albedo_contrast: 0.03,
            crater_density: 0.45,
            smallest_crater_m: 0.3,
            largest_crater_m: 800.0,
            crater_exponent: 1.85,
            crater_depth_ratio: 0.2,
            rock_abundance: 0.05,
            smallest_rock_m: 0.06,
            largest_rock_m: 4.0,
            hummock_density: 0.5,
            smallest_hummock_m: 2.0,
            largest_hummock_m: 256.0,
            hummock_height_ratio: 0.08,
            ripple_cover: 0.3,
            largest_ripple_m: 28.0,
            smallest_ripple_m: 0.5,
            ripple_height_ratio: 0.07,
            unit_contrast: 0.51,
            largest_unit_m: 3500.0,
            smallest_unit_m: 10.0,
            scarp_ratio: 0.007,
            site_slope: 0.05,
        }
    }
}

impl TerrainConfig {
    /// Level ground of one albedo but for the mottling of `albedo_contrast`: no relief and no features.
    pub fn level() -> Self {
        TerrainConfig { rms_slope: 0.0, ..TerrainConfig::default() }.without_features()
    }

    /// The same fractal relief without craters, rocks, hummocks, ripples and geological units.
    pub fn without_features(self) -> Self {
        TerrainConfig {
            crater_density: 0.0,
            rock_abundance: 0.0,
            hummock_density: 0.0,
            ripple_cover: 0.0,
            unit_contrast: 0.0,
            scarp_ratio: 0.0,
            ..self
        }
    }

    /// Checks every parameter's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        let ranges = [
            ("largest_wavelength_m", self.largest_wavelength_m, 1.0, 1e5),
            ("smallest_wavelength_m", self.smallest_wavelength_m, 1e-3, 1e3),
            ("hurst", self.hurst, 0.0, 1.0),
            ("rms_slope", self.rms_slope, 0.0, 1.0),
            ("slope_scale_m", self.slope_scale_m, 1e-3, 1e5),
            ("albedo", self.albedo, 0.0, 1.0),
            ("sky_light", self.sky_light, 0.0, 1.0),
            ("albedo_contrast", self.albedo_contrast, 0.0, 0.3),
            ("crater_density", self.crater_density, 0.0, 1.0),
            ("smallest_crater_m", self.smallest_crater_m, 0.01, 1e4),
            ("largest_crater_m", self.largest_crater_m, 0.01, 1e4),
            ("crater_exponent", self.crater_exponent, 0.5, 5.0),
            ("crater_depth_ratio", self.crater_depth_ratio, 0.0, 0.4),
            ("rock_abundance", self.rock_abundance, 0.0, 0.4),
            ("smallest_rock_m", self.smallest_rock_m, 0.01, 100.0),
            ("largest_rock_m", self.largest_rock_m, 0.01, 100.0),
            ("hummock_density", self.hummock_density, 0.0, 1.0),
            ("smallest_hummock_m", self.smallest_hummock_m, 0.1, 1e4),
            ("largest_hummock_m", self.largest_hummock_m, 0.1, 1e4),
            ("hummock_height_ratio", self.hummock_height_ratio, 0.0, 0.3),
            ("ripple_cover", self.ripple_cover, 0.0, 1.0),
            ("largest_ripple_m", self.largest_ripple_m, 0.05, 1e3),
            ("smallest_ripple_m", self.smallest_ripple_m, 0.05, 1e3),
            ("ripple_height_ratio", self.ripple_height_ratio, 0.0, 0.15),
            ("unit_contrast", self.unit_contrast, 0.0, 1.0),
            ("largest_unit_m", self.largest_unit_m, 1.0, 1e5),
            ("smallest_unit_m", self.smallest_unit_m, 1.0, 1e5),
            ("scarp_ratio", self.scarp_ratio, 0.0, 0.05),
            ("site_slope", self.site_slope, 0.0, 1.0),
        ];
        for (key, value, low, high) in ranges {
            limits::within(key, value, low, high)?;
        }
        if self.smallest_wavelength_m > self.largest_wavelength_m {
            let cure = "it must be below largest_wavelength_m";
            return Err(OutOfRange::new("smallest_wavelength_m", self.smallest_wavelength_m, cure));
        }
        Ok(())
    }
}
