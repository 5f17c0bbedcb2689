//! Settings of the sky behind a small body.

use super::catalogue::Star;
use super::sky::Sky;
use crate::scene::error::SceneError;
use crate::settings::{OutOfRange, limits};
use nalgebra::UnitQuaternion;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// The sky behind a small body: black, or with stars.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SkyConfig {
    /// Whether stars are drawn (default false).
    pub stars: bool,
    /// CSV file with the columns ra_deg, dec_deg (ICRF) and magnitude; a relative path starts at the folder of the scenario
    /// file (default: a built-in list of the brightest stars).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub catalogue: Option<PathBuf>,
    /// Magnitude of the faintest stars drawn, -30 to 30 (default 6.5).
    pub faintest_magnitude: f64,
    /// Light of a star of magnitude 0, summed over the pixels that it falls on, in I/F times px (default: what the camera
    /// would see beside the body, from the Sun's magnitude and distance; exposed for a body, most stars are then too faint
    /// to see).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub zero_point_if_px: Option<f64>,
}

impl Default for SkyConfig {
    fn default() -> Self {
        SkyConfig { stars: false, catalogue: None, faintest_magnitude: 6.5, zero_point_if_px: None }
    }
}

impl SkyConfig {
    /// The sky in inertial axes.
    ///
    /// # Errors
    /// Names the catalogue's file and line at fault.
    pub fn sky(
        &self,
        inertial_from_icrf: &UnitQuaternion<f64>,
        sun_distance_au: f64,
        base_folder: &Path,
    ) -> Result<Sky, SceneError> {
        let in_icrf = match &self.catalogue {
            _ if !self.stars => Vec::new(),
            None => Star::brightest(),
            Some(path) => Star::read_csv(&base_folder.join(path))?,
        };
        let bright = in_icrf.into_iter().filter(|star| star.magnitude <= self.faintest_magnitude);
        let stars = bright.map(|star| Star { direction: inertial_from_icrf * star.direction, ..star }).collect();
        Ok(Sky { stars, zero_point_if_px: self.zero_point_if_px, sun_distance_au })
    }

    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::within("faintest_magnitude", self.faintest_magnitude, -30.0, 30.0)?;
        self.zero_point_if_px.map_or(Ok(()), |light| limits::positive("zero_point_if_px", light))
    }
}
