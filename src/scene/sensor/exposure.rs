//! How much light is collected.

use crate::settings::{OutOfRange, limits};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How the exposure is chosen.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub enum Exposure {
    /// For each image: the 99th percentile of the lit pixels' irradiance stands at 80 % of the full well.
    #[default]
    Auto,
    /// For each image: a percentile of the lit pixels' irradiance stands at a share of the full well.
    Percentile {
        /// Share of the lit pixels below the level in percent, 0 to 100.
        percent: f64,
        /// The level over the full well, above 0, to 10.
        full_well_share: f64,
    },
    /// The same for all images.
    Fixed {
        /// Electrons per unit of I/F.
        electrons_per_radiance: f64,
    },
    /// The same for all images, from the exposure time.
    Timed {
        /// Electrons per unit of I/F and second of exposure time.
        electrons_per_radiance_s: f64,
    },
}

impl Exposure {
    /// The percentile (0 to 1) and its share of the full well, if each image has its own exposure.
    pub fn automatic_level(&self) -> Option<(f64, f64)> {
        match *self {
            Exposure::Auto => Some((0.99, 0.8)),
            Exposure::Percentile { percent, full_well_share } => Some((0.01 * percent, full_well_share)),
            Exposure::Fixed { .. } | Exposure::Timed { .. } => None,
        }
    }

    pub(super) fn validate(&self) -> Result<(), OutOfRange> {
        match *self {
            Exposure::Auto => Ok(()),
            Exposure::Percentile { percent, full_well_share } => {
                limits::within("percentile.percent", percent, 0.0, 100.0)?;
                limits::within("percentile.full_well_share", full_well_share, 1e-6, 10.0)
            }
            Exposure::Fixed { electrons_per_radiance } => {
                limits::positive("fixed.electrons_per_radiance", electrons_per_radiance)
            }
            Exposure::Timed { electrons_per_radiance_s } => {
                limits::positive("timed.electrons_per_radiance_s", electrons_per_radiance_s)
            }
        }
    }
}
