//! Where the posts of a raster lie on its map.

use super::map_site::MapPlace;

/// Where the posts of a raster lie: on a plane map in metres, or on a grid of latitude and longitude (simple
/// cylindrical). Posts are counted from 0; a post is the centre of its cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Georeference {
    /// A plane map: x east, y north, in m.
    Metres {
        /// Place (x, y) of the first post of the first row, m.
        first_m: [f64; 2],
        /// From a post to the next of its row along +x, and from a row to the next along -y, m.
        step_m: [f64; 2],
    },
    /// Longitude eastward and latitude northward, in degrees, on a sphere.
    Degrees {
        /// Longitude and latitude of the first post of the first row.
        first_deg: [f64; 2],
        /// From a post to the next of its row eastward, and from a row to the next southward, degrees.
        step_deg: [f64; 2],
        /// Radius that heights are counted from, m.
        radius_m: f64,
    },
}

impl Georeference {
    /// Column and row of a place on the map; `None` if the place is of the other kind. Longitudes may be off by whole
    /// turns: the column is the one nearest to the middle of the raster.
    pub fn column_row(&self, place: &MapPlace, columns: usize) -> Option<[f64; 2]> {
        match (*self, *place) {
            (Georeference::Metres { first_m, step_m }, MapPlace::Metres { x_m, y_m }) => {
                Some([(x_m - first_m[0]) / step_m[0], (first_m[1] - y_m) / step_m[1]])
            }
            (Georeference::Degrees { first_deg, step_deg, .. }, MapPlace::Degrees { latitude_deg, longitude_deg }) => {
                let column = (longitude_deg - first_deg[0]) / step_deg[0];
                Some([nearest_turn(column, columns, step_deg[0]), (first_deg[1] - latitude_deg) / step_deg[1]])
            }
            _ => None,
        }
    }

    /// The place of a column and a row.
    pub fn place(&self, [column, row]: [f64; 2]) -> MapPlace {
        match *self {
            Georeference::Metres { first_m, step_m } => {
                MapPlace::Metres { x_m: first_m[0] + column * step_m[0], y_m: first_m[1] - row * step_m[1] }
            }
            Georeference::Degrees { first_deg, step_deg, .. } => MapPlace::Degrees {
                latitude_deg: first_deg[1] - row * step_deg[1],
                longitude_deg: first_deg[0] + column * step_deg[0],
            },
        }
    }

    /// Whether the last column of a raster borders on the first: it goes around the planet.
    pub fn wraps(&self, columns: usize) -> bool {
        match *self {
            Georeference::Metres { .. } => false,
            Georeference::Degrees { step_deg, .. } => {
                (step_deg[0].abs() * columns as f64 - 360.0).abs() < 0.01 * step_deg[0].abs()
            }
        }
    }
}

/// The column shifted by whole turns to lie nearest to the middle of the raster.
pub(super) fn nearest_turn(column: f64, columns: usize, step_deg: f64) -> f64 {
    let turn = 360.0 / step_deg.abs();
    let middle = 0.5 * (columns as f64 - 1.0);
    column - turn * ((column - middle) / turn).round()
}
