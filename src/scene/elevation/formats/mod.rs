//! Elevation files: GeoTIFF, PDS, PNG, and the raster that each is read into.

mod file_raster;
mod geokeys;
pub mod geotiff;
pub mod pds;
mod pds_label;
mod pds_map;
pub mod png;
mod raw_samples;

pub use file_raster::{FileGeoreference, FileRaster};
pub use raw_samples::{RawLayout, SampleKind};
