//! A raster as it comes from a file.

use super::config::{RasterFile, RasterGeometry};
use super::formats::{FileGeoreference, FileRaster, geotiff, pds, png};
use super::georeference::Georeference;
use super::map_site::MapPlace;
use crate::scene::error::SceneError;
use std::path::Path;

/// Radius of Mars in m: that of its IAU sphere.
const MARS_RADIUS_M: f64 = 3_396_190.0;

/// Values on a map.
#[derive(Debug, Clone, PartialEq)]
pub struct Raster {
    /// Values in a row.
    pub columns: usize,
    /// Values row by row, the northernmost row first; NaN where nothing is known.
    pub values: Vec<f32>,
    /// Where the posts lie.
    pub georeference: Georeference,
}

impl Raster {
    /// Reads a file and applies the scenario's settings for it.
    ///
    /// # Errors
    /// Names the file of: a missing or truncated file, an unknown format, an unknown map without a geometry in the
    /// scenario, a raster without a single value.
    pub fn read(file: &RasterFile, base_folder: &Path) -> Result<Raster, SceneError> {
        let path = base_folder.join(&file.path);
        let unusable = |problem: String| SceneError::Unusable { path: path.clone(), problem };
        let found = read_any(file, &path)?;
        let rows = found.values.len() / found.columns;
        if found.columns < 2 || rows < 2 {
            return Err(unusable(format!("it has {} × {rows} posts: 2 × 2 are needed", found.columns)));
        }
        let georeference = georeference(file, &found).map_err(unusable)?;
        let known = |v: f64| v.is_finite() && !file.no_data.contains(&v);
        let value = |v: &f64| if known(*v) { (v * file.scale + file.offset) as f32 } else { f32::NAN };
        let values: Vec<f32> = found.values.iter().map(value).collect();
        if values.iter().all(|v| v.is_nan()) {
            return Err(unusable("not one of its values is known (all are no-data): use another file".into()));
        }
        Ok(Raster { columns: found.columns, values, georeference })
    }

    /// Rows.
    pub fn rows(&self) -> usize {
        self.values.len() / self.columns
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

fn read_any(file: &RasterFile, path: &Path) -> Result<FileRaster, SceneError> {
    let bytes = std::fs::read(path).map_err(|source| SceneError::Io {
        action: "read the raster",
        path: path.into(),
        source,
    })?;
    let unusable = |problem: String| SceneError::Unusable { path: path.into(), problem };
    if let Some(layout) = &file.layout {
        layout.check_size().map_err(unusable)?;
        let values = layout.values(&bytes, [0, 0]).map_err(unusable)?;
        return Ok(FileRaster { columns: layout.columns, values, georeference: None });
    }
    let lacks_geometry = file.geometry == RasterGeometry::InFile;
    match bytes.get(..4) {
        Some(b"II*\0" | b"MM\0*" | b"II+\0" | b"MM\0+") => geotiff::read(&bytes, lacks_geometry).map_err(unusable),
        Some(b"\x89PNG" | b"\xff\xd8\xff\xe0" | b"\xff\xd8\xff\xe1" | b"\xff\xd8\xff\xdb" | b"\xff\xd8\xff\xee") => {
            png::read(&bytes).map_err(unusable)
        }
        _ => pds::read(path, bytes, lacks_geometry),
    }
}

fn georeference(file: &RasterFile, found: &FileRaster) -> Result<Georeference, String> {
    match (file.geometry, found.georeference) {
        (RasterGeometry::Metres { metres_per_px, first_x_m, first_y_m }, _) => {
            Ok(Georeference::Metres { first_m: [first_x_m, first_y_m], step_m: [metres_per_px; 2] })
        }
        (RasterGeometry::Degrees { px_per_deg, first_longitude_deg, first_latitude_deg }, _) => {
            Ok(Georeference::Degrees {
                first_deg: [first_longitude_deg, first_latitude_deg],
                step_deg: [1.0 / px_per_deg; 2],
                radius_m: file.radius_m.unwrap_or(MARS_RADIUS_M),
            })
        }
        (RasterGeometry::InFile, Some(FileGeoreference::Metres { first_m, step_m })) => {
            Ok(Georeference::Metres { first_m, step_m })
        }
        (RasterGeometry::InFile, Some(FileGeoreference::Degrees { first_deg, step_deg, radius_m })) => {
            let radius_m = file.radius_m.or(radius_m).unwrap_or(MARS_RADIUS_M);
            Ok(Georeference::Degrees { first_deg, step_deg, radius_m })
        }
        (RasterGeometry::InFile, None) => Err("it does not say where its posts lie: state it in the scenario, as \
                                               file.geometry.metres or file.geometry.degrees"
            .into()),
    }
}
