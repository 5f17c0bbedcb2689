//! Differences between pixels that are the same in every image of a camera.

use crate::settings::{OutOfRange, limits};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Fixed pattern of a detector; EMVA 1288 calls its parts PRNU and DSNU.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct FixedPatternConfig {
    /// Photo-response non-uniformity: relative standard deviation of the pixels' sensitivity, 0 to 0.5 (default 0).
    pub response_sigma: f64,
    /// Dark-signal non-uniformity: standard deviation of the pixels' offset in electrons, 0 to 1e6 (default 0).
    pub offset_sigma_electrons: f64,
    /// Share of hot pixels, 0 to 1 (default 0).
    pub hot_pixel_fraction: f64,
    /// Mean dark current of hot pixels beyond that of the others, in electrons per second, 0 to 1e12 (default 0); it
    /// varies from one to the next by the exponential distribution.
    pub hot_pixel_electrons_s: f64,
}

impl FixedPatternConfig {
    pub(super) fn validate(&self) -> Result<(), OutOfRange> {
        limits::within("response_sigma", self.response_sigma, 0.0, 0.5)?;
        limits::within("offset_sigma_electrons", self.offset_sigma_electrons, 0.0, 1e6)?;
        limits::within("hot_pixel_fraction", self.hot_pixel_fraction, 0.0, 1.0)?;
        limits::within("hot_pixel_electrons_s", self.hot_pixel_electrons_s, 0.0, 1e12)
    }
}
