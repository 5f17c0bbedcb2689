//! A place on a map.

use super::config::MapSite;
use super::raster::Raster;
use crate::scene::error::SceneError;
use serde::Serialize;
use std::fmt::{self, Display, Formatter};

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

impl Raster {
    /// Column and row of a place, which has to lie on the raster; the middle without one.
    ///
    /// # Errors
    /// Names `key` if the place is of the other kind of map or outside.
    pub(super) fn site_column_row(&self, place: Option<&MapPlace>, key: &str) -> Result<[f64; 2], SceneError> {
        let last = [self.columns as f64 - 1.0, self.rows() as f64 - 1.0];
        let Some(place) = place else { return Ok(last.map(|l| (0.5 * l).round())) };
        let at = self.georeference.column_row(place, self.columns).ok_or_else(|| {
            let middle = self.georeference.place(last.map(|l| 0.5 * l));
            SceneError::out_of_range(key, place, format!("the map's middle is {middle}: state the site in its terms"))
        })?;
        let wraps = self.georeference.wraps(self.columns);
        if (!wraps && !(0.0..=last[0]).contains(&at[0])) || !(0.0..=last[1]).contains(&at[1]) {
            let (first, end) = (self.georeference.place([0.0, 0.0]), self.georeference.place(last));
            let cure = format!("the file covers ({first}) to ({end}): choose a place inside or another file");
            return Err(SceneError::out_of_range(key, place, cure));
        }
        Ok(at)
    }

    /// Whether not one of the four posts around a column and a row is known.
    pub(super) fn is_unknown_around(&self, at: [f64; 2]) -> bool {
        let clamped = |c: f64, last: usize| (c.max(0.0) as usize).min(last);
        let corner = |k: usize| {
            let column = clamped((at[0] + (k % 2) as f64).floor(), self.columns - 1);
            let row = clamped((at[1] + (k / 2) as f64).floor(), self.rows() - 1);
            self.values[row * self.columns + column].is_nan()
        };
        (0..4).all(corner)
    }
}
