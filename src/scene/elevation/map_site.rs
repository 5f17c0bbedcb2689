//! Where on a map the site lies.

use crate::settings::{OutOfRange, limits};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::fmt::{Display, Formatter};

/// A place on a map.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum MapPlace {
    /// On a plane map.
    Metres {
        /// East coordinate in m.
        x_m: f64,
        /// North coordinate in m.
        y_m: f64,
    },
    /// On a sphere.
    Degrees {
        /// Latitude.
        latitude_deg: f64,
        /// East longitude.
        longitude_deg: f64,
    },
}

impl Display for MapPlace {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            MapPlace::Metres { x_m, y_m } => write!(f, "x {x_m:.1} m, y {y_m:.1} m"),
            MapPlace::Degrees { latitude_deg, longitude_deg } => {
                write!(f, "latitude {latitude_deg:.5}°, longitude {longitude_deg:.5}°")
            }
        }
    }
}

/// Where the site's origin lies on a map.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub enum MapSite {
    /// In the middle of the raster.
    #[default]
    Middle,
    /// At a place of a map in degrees.
    Degrees {
        /// Latitude.
        latitude_deg: f64,
        /// East longitude.
        longitude_deg: f64,
    },
    /// At a place of a map in metres.
    Metres {
        /// East coordinate in m.
        x_m: f64,
        /// North coordinate in m.
        y_m: f64,
    },
}

impl MapSite {
    pub(super) fn validate(&self) -> Result<(), OutOfRange> {
        match *self {
            MapSite::Middle => Ok(()),
            MapSite::Degrees { latitude_deg, longitude_deg } => {
                limits::within("degrees.latitude_deg", latitude_deg, -89.9, 89.9)?;
                limits::within("degrees.longitude_deg", longitude_deg, -360.0, 360.0)
            }
            MapSite::Metres { x_m, y_m } => {
                limits::finite("metres.x_m", &[x_m])?;
                limits::finite("metres.y_m", &[y_m])
            }
        }
    }
}

impl MapSite {
    /// The place that a scenario states; `None` for the middle.
    pub fn stated(&self) -> Option<MapPlace> {
        match *self {
            MapSite::Middle => None,
            MapSite::Degrees { latitude_deg, longitude_deg } => Some(MapPlace::Degrees { latitude_deg, longitude_deg }),
            MapSite::Metres { x_m, y_m } => Some(MapPlace::Metres { x_m, y_m }),
        }
    }
}
