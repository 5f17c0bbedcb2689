//! When light is collected.

use crate::settings::{OutOfRange, limits};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A shutter. The time stamp of an image is the middle of the exposure of its middle row, and the truth is the truth of
/// that moment.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ShutterConfig {
    /// Time during which a row collects light in s, 0 to 3600 (default 0: an instant).
    pub exposure_time_s: f64,
    /// Time from the read-out of a row to that of the row below in s, 0 to 1 (default 0: a global shutter).
    pub row_time_s: f64,
    /// Whether motion during the exposure is drawn (default true).
    pub motion: bool,
    /// Most images that one image with motion is made of, 1 to 1024 (default 64).
    pub sub_pictures_at_most: u32,
}

impl Default for ShutterConfig {
    fn default() -> Self {
        ShutterConfig { exposure_time_s: 0.0, row_time_s: 0.0, motion: true, sub_pictures_at_most: 64 }
    }
}

impl ShutterConfig {
    pub(super) fn validate(&self) -> Result<(), OutOfRange> {
        limits::within("exposure_time_s", self.exposure_time_s, 0.0, 3600.0)?;
        limits::within("row_time_s", self.row_time_s, 0.0, 1.0)?;
        limits::count("sub_pictures_at_most", self.sub_pictures_at_most as usize, 1, 1024)
    }
}
