//! What the camera's detector does to a picture.

use super::{SceneError, limits};
use serde::{Deserialize, Serialize};

/// How the exposure is chosen.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub enum Exposure {
    /// For each picture: the 99th percentile of the lit radiance stands at 80 % of the full well.
    #[default]
    Auto,
    /// The same for all pictures.
    Fixed {
        /// Electrons per unit of I/F.
        electrons_per_radiance: f64,
    },
}

/// A detector.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SensorConfig {
    /// Electrons at the largest digital number (default 20 000).
    pub full_well_electrons: f64,
    /// R.m.s. read noise in electrons (default 10).
    pub read_noise_electrons: f64,
    /// Bits a pixel, 1 to 8 (default 8).
    pub bits: u32,
    /// How the exposure is chosen (default `auto`).
    pub exposure: Exposure,
    /// Standard deviation of the Gaussian point-spread function in px (default 0.5).
    pub psf_sigma_px: f64,
    /// Whether shot and read noise are added (default true).
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

impl SensorConfig {
    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), SceneError> {
        limits::positive("full_well_electrons", self.full_well_electrons)?;
        limits::within("read_noise_electrons", self.read_noise_electrons, 0.0, 1e6)?;
        limits::count("bits", self.bits as usize, 1, 8)?;
        limits::within("psf_sigma_px", self.psf_sigma_px, 0.0, 10.0)?;
        match self.exposure {
            Exposure::Auto => Ok(()),
            Exposure::Fixed { electrons_per_radiance } => {
                limits::positive("exposure.fixed.electrons_per_radiance", electrons_per_radiance)
            }
        }
    }
}
