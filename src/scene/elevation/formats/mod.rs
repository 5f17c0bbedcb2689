//! Files of elevation and orthoimages: GeoTIFF (`geotiff`, `geokeys`), PDS (`pds`, its label and map projection), PNG
//! and raw samples, each read into the same `file_raster` with its georeference. Errors name the file and the key or
//! tag.

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
