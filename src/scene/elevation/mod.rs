//! Measured elevation models and orthoimages as the base of the terrain.
//!
//! A file (GeoTIFF, PDS3 image, TIFF, PNG, JPEG or bare samples) becomes a [`Raster`] on a map. A [`GroundBase`] moves it
//! into the site frame, with the site's origin on the ground, and gives height, gradient and albedo at any place:
//! bicubic between posts, with the planet's curvature if the map is in degrees, exact at the posts. Posts without data are
//! filled from their surroundings and counted. Beyond the border the ground goes on with the border's heights; the path of
//! a lander must stay inside. Procedural detail is added only below the posts' resolution, see [`Terrain`](super::terrain::Terrain).

mod block_bounds;
mod config;
mod elevation_model;
mod fill;
mod formats;
mod georeference;
mod grid;
mod map_site;
mod orthoimage;
mod raster;
mod site_map;

pub use config::{AlbedoValues, ElevationConfig, OrthoimageConfig, RasterFile, RasterGeometry};
pub use elevation_model::{ElevationModel, ElevationSummary};
pub use formats::{RawLayout, SampleKind};
pub use georeference::Georeference;
pub use map_site::{MapPlace, MapSite};
pub use orthoimage::Orthoimage;
pub use raster::Raster;
