//! A raster as it comes from a file.

use super::config::{RasterFile, RasterGeometry};
use super::formats::{geotiff, pds, png};
use super::georeference::Georeference;
use crate::scene::error::SceneError;
use std::path::Path;

/// Radius of Mars in m: that of its IAU sphere.
const MARS_RADIUS_M: f64 = 3_396_190.0;
/// Most posts of a raster, so that it fits in memory.
pub(super) const MOST_POSTS: usize = 100_000_000;

/// A raster as its file holds it, before any setting of the scenario.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FileRaster {
    pub columns: usize,
    /// Row by row from the top; NaN where the file says that it does not know.
    pub values: Vec<f64>,
    pub georeference: Option<FileGeoreference>,
}

/// What a file says of its map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum FileGeoreference {
    Metres { first_m: [f64; 2], step_m: [f64; 2] },
    Degrees { first_deg: [f64; 2], step_deg: [f64; 2], radius_m: Option<f64> },
}

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

/// What to say of a raster that does not fit in memory.
pub(super) fn too_many([columns, rows]: [usize; 2]) -> String {
    format!("it has {columns} × {rows} posts, and {MOST_POSTS} are allowed: cut out the part around the site")
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
