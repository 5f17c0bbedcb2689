//! What the camera's detector does to a picture.

use serde::{Deserialize, Serialize};

/// How the exposure is chosen.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Exposure {
    /// The 99th percentile of the lit radiance stands at 80 % of the full well.
    Auto,
    /// Electrons per unit of I/F.
    Fixed {
        /// Electrons per unit of I/F.
        electrons_per_radiance: f64,
    },
}

/// A detector.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct SensorConfig {
    /// Electrons at the largest digital number.
    pub full_well_electrons: f64,
    /// R.m.s. read noise in electrons.
    pub read_noise_electrons: f64,
    /// Bits a pixel.
    pub bits: u32,
    /// How the exposure is chosen.
    pub exposure: Exposure,
    /// Standard deviation of the Gaussian point-spread function in px.
    pub psf_sigma_px: f64,
    /// Whether shot and read noise are added.
    pub noise: bool,
}

impl Default for SensorConfig {
    fn default() -> Self {
        SensorConfig {
            full_well_electrons: 20_000.0,
            read_noise_electrons: 10.0,
            bits: 8,
            exposure: Exposure::Auto,
            psf_sigma_px: 0.5,
            noise: true,
        }
    }
}
