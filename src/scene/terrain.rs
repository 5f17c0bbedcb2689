//! Flat ground.

use nalgebra::{Unit, Vector3};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// A parameter of the terrain outside its range.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("terrain.{key} is {value}: it must be {range}")]
pub struct TerrainConfigError {
    /// Key as in the scenario file.
    pub key: &'static str,
    /// The value found.
    pub value: f64,
    /// What it may be.
    pub range: &'static str,
}

/// Parameters of the terrain.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TerrainConfig {
    /// Mean albedo, 0 to 1 (default 0.2).
    pub albedo: f64,
}

impl Default for TerrainConfig {
    fn default() -> Self {
        TerrainConfig { albedo: 0.2 }
    }
}

impl TerrainConfig {
    /// Checks every parameter's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), TerrainConfigError> {
        if (0.0..=1.0).contains(&self.albedo) {
            return Ok(());
        }
        Err(TerrainConfigError { key: "albedo", value: self.albedo, range: "0 to 1" })
    }
}

/// Terrain in the site frame: z up, origin on the ground at the landing point.
#[derive(Debug, Clone, PartialEq)]
pub struct Terrain {
    albedo: f64,
}

impl Terrain {
    /// Terrain of a configuration.
    pub fn new(config: &TerrainConfig, _seed: u64) -> Self {
        Terrain { albedo: config.albedo }
    }

    /// Height of the ground in m at a place in m; 0 at the origin.
    pub fn height_m(&self, _x_m: f64, _y_m: f64) -> f64 {
        0.0
    }

    /// Albedo at a place in m.
    pub fn albedo(&self, _x_m: f64, _y_m: f64) -> f64 {
        self.albedo
    }

    /// Range in m along a unit direction to the ground; both are in the site frame.
    pub fn ray_cast(&self, origin_in_site_m: &Vector3<f64>, direction: &Unit<Vector3<f64>>) -> Option<f64> {
        let range_m = -origin_in_site_m.z / direction.z;
        (range_m >= 0.0 && range_m.is_finite()).then_some(range_m)
    }
}
