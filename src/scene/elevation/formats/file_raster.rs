//! A raster as its file holds it, before it is placed on the ground.

/// Most posts of a raster, so that it fits in memory.
pub(super) const MOST_POSTS: usize = 100_000_000;

/// A raster as its file holds it, before any setting of the scenario.
#[derive(Debug, Clone, PartialEq)]
pub struct FileRaster {
    pub columns: usize,
    /// Row by row from the top; NaN where the file says that it does not know.
    pub values: Vec<f64>,
    pub georeference: Option<FileGeoreference>,
}

/// What a file says of its map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FileGeoreference {
    Metres { first_m: [f64; 2], step_m: [f64; 2] },
    Degrees { first_deg: [f64; 2], step_deg: [f64; 2], radius_m: Option<f64> },
}

/// What to say of a raster that does not fit in memory.
pub(super) fn too_many([columns, rows]: [usize; 2]) -> String {
    format!("it has {columns} × {rows} posts, and {MOST_POSTS} are allowed: cut out the part around the site")
}
