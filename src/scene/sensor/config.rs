//! What the camera's detector does to an image.

use super::exposure::Exposure;
use super::fixed_pattern::FixedPatternConfig;
use super::shutter::ShutterConfig;
use super::vignetting::VignettingConfig;
use crate::settings::{OutOfRange, limits};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A detector, after the linear camera model of EMVA 1288 (release 4.0). Stages in physical order: vignetting, point
/// spread, exposure to electrons, dark current, shot noise, fixed pattern, full well, read noise, gain, black level,
/// digital numbers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SensorConfig {
    /// Electrons that a pixel holds at most, 1 to 1e12 (default 20000).
    pub full_well_electrons: f64,
    /// R.m.s. read noise in electrons, 0 to 1e6 (default 10).
    pub read_noise_electrons: f64,
    /// Mean dark current in electrons per second and pixel; it collects during the exposure time, 0 to 1e9 (default 0).
    pub dark_current_electrons_s: f64,
    /// Bits a pixel, 1 to 16 (default 8). Digital numbers run from 0 to 2^bits - 1. Images of up to 8 bits are stored
    /// in 8-bit files, others in 16-bit files, the numbers as they are: an image of 12 bits ends at 4095.
    pub bits: u32,
    /// Gain in electrons per digital number, 1e-6 to 1e9 (default: a full well reads as the largest number).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub electrons_per_dn: Option<f64>,
    /// Digital number of a pixel without electrons (default 0).
    pub black_level_dn: f64,
    /// How much light is collected (default `auto`).
    pub exposure: Exposure,
    /// When light is collected.
    pub shutter: ShutterConfig,
    /// Fall of brightness toward the image's edge.
    pub vignetting: VignettingConfig,
    /// Standard deviation of the Gaussian point-spread function in px, 0 to 10 (default 0.5).
    pub psf_sigma_px: f64,
    /// Radius in px of the disc that defocus makes of a point, 0 to 20 (default 0).
    pub defocus_radius_px: f64,
    /// Differences between pixels that stay.
    pub fixed_pattern: FixedPatternConfig,
    /// Whether shot and read noise are added (default true). The fixed pattern and the mean dark current stay.
    pub noise: bool,
}

impl Default for SensorConfig {
    fn default() -> Self {
        SensorConfig {
            full_well_electrons: 20_000.0,
            read_noise_electrons: 10.0,
            dark_current_electrons_s: 0.0,
            bits: 8,
            electrons_per_dn: None,
            black_level_dn: 0.0,
            exposure: Exposure::Auto,
            shutter: ShutterConfig::default(),
            vignetting: VignettingConfig::default(),
            psf_sigma_px: 0.5,
            defocus_radius_px: 0.0,
            fixed_pattern: FixedPatternConfig::default(),
            noise: true,
        }
    }
}

impl SensorConfig {
    /// Largest digital number.
    pub fn largest_dn(&self) -> f64 {
        f64::from((1_u32 << self.bits.min(16)) - 1)
    }

    /// Bits a pixel, unless the images' files say it themselves: those of 8 and of 16 bits do.
    pub fn stored_bits(&self) -> Option<u32> {
        Some(self.bits).filter(|bits| !matches!(bits, 8 | 16))
    }

    /// Gain in electrons per digital number.
    pub fn gain_electrons_per_dn(&self) -> f64 {
        let full_range = self.full_well_electrons / (self.largest_dn() - self.black_level_dn);
        self.electrons_per_dn.unwrap_or(full_range)
    }

    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::within("full_well_electrons", self.full_well_electrons, 1.0, 1e12)?;
        limits::within("read_noise_electrons", self.read_noise_electrons, 0.0, 1e6)?;
        limits::within("dark_current_electrons_s", self.dark_current_electrons_s, 0.0, 1e9)?;
        limits::count("bits", self.bits as usize, 1, 16)?;
        limits::within("black_level_dn", self.black_level_dn, 0.0, 0.9 * self.largest_dn())?;
        if let Some(gain) = self.electrons_per_dn {
            limits::within("electrons_per_dn", gain, 1e-6, 1e9)?;
        }
        limits::within("psf_sigma_px", self.psf_sigma_px, 0.0, 10.0)?;
        limits::within("defocus_radius_px", self.defocus_radius_px, 0.0, 20.0)?;
        self.shutter.validate().map_err(|e| e.under("shutter"))?;
        self.vignetting.validate().map_err(|e| e.under("vignetting"))?;
        self.fixed_pattern.validate().map_err(|e| e.under("fixed_pattern"))?;
        self.exposure.validate().map_err(|e| e.under("exposure"))?;
        self.check_exposure_time()
    }

    /// What collects with time needs a time.
    fn check_exposure_time(&self) -> Result<(), OutOfRange> {
        let timed = matches!(self.exposure, Exposure::Timed { .. });
        let dark = self.dark_current_electrons_s > 0.0 || self.fixed_pattern.hot_pixel_fraction > 0.0;
        if (timed || dark) && self.shutter.exposure_time_s == 0.0 {
            let cure = "dark current, hot pixels and exposure.timed collect electrons during it: give it in seconds";
            return Err(OutOfRange::new("shutter.exposure_time_s", 0.0, cure));
        }
        Ok(())
    }
}
