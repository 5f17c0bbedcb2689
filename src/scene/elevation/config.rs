//! Settings of elevation models and orthoimages.

use super::formats::RawLayout;
use super::map_site::MapSite;
use crate::settings::{OutOfRange, limits};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// A measured elevation model as the base of the terrain: the table `[descent.elevation]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ElevationConfig {
    /// Whether procedural relief, craters and rocks are added below the model's resolution, in waves of up to two posts
    /// (default true). Without them the ground is the interpolated model alone.
    #[serde(default = "yes")]
    pub detail: bool,
    /// The file; its values times scale plus offset are heights in m.
    pub file: RasterFile,
    /// Where on the map the site's origin lies (default `middle`).
    #[serde(default)]
    pub site: MapSite,
}

/// An image of the ground from above as its albedo: the table `[descent.orthoimage]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OrthoimageConfig {
    /// What the values mean (default `relative`).
    #[serde(default)]
    pub values: AlbedoValues,
    /// Whether procedural changes of albedo are added below the image's resolution (default true).
    #[serde(default = "yes")]
    pub detail: bool,
    /// The file.
    pub file: RasterFile,
    /// Where on the image's map the site's origin lies (default: where it lies on the elevation model's map; the middle
    /// without one).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub site: Option<MapSite>,
}

/// What the values of an orthoimage mean.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum AlbedoValues {
    /// Brightness: the terrain's mean albedo times the value over the image's mean. The image's own shading by the
    /// Sun stays in it.
    #[default]
    Relative,
    /// Albedo: the value times scale plus offset.
    Absolute,
}

/// A file of heights or albedo: GeoTIFF, PDS3 image (with its label attached or beside it), TIFF, PNG, JPEG, or bare
/// samples.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RasterFile {
    /// The file; a relative path starts at the folder of the scenario file.
    pub path: PathBuf,
    /// Factor from the file's values (after any scaling that the file itself states) to m or albedo (default 1).
    #[serde(default = "one")]
    pub scale: f64,
    /// What is added after `scale`, m or albedo (default 0).
    #[serde(default)]
    pub offset: f64,
    /// Values of the file that mean "not known", beside those that the file names (default none).
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub no_data: Vec<f64>,
    /// Radius of the planet in m for a map in degrees, 1000 to 1e9 (default: what the file says, or 3396190, which is
    /// Mars).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius_m: Option<f64>,
    /// Where the posts lie (default: as the file says).
    #[serde(default)]
    pub geometry: RasterGeometry,
    /// How the samples of a file without any header are laid out (default: the file has a header).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub layout: Option<RawLayout>,
}

/// Where the posts of a raster lie. A post is the centre of its pixel.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub enum RasterGeometry {
    /// As the file says: GeoTIFF and PDS.
    #[default]
    InFile,
    /// On a plane, north up.
    Metres {
        /// Edge of a pixel in m.
        metres_per_px: f64,
        /// East coordinate of the first pixel's centre, m (default 0).
        #[serde(default)]
        first_x_m: f64,
        /// North coordinate of the first pixel's centre, m (default 0).
        #[serde(default)]
        first_y_m: f64,
    },
    /// Simple cylindrical, north up.
    Degrees {
        /// Pixels in one degree.
        px_per_deg: f64,
        /// East longitude of the first pixel's centre.
        first_longitude_deg: f64,
        /// Latitude of the first pixel's centre.
        first_latitude_deg: f64,
    },
}

fn one() -> f64 {
    1.0
}
fn yes() -> bool {
    true
}

impl ElevationConfig {
    /// The elevation model in a file, with defaults for all else.
    pub fn from_path(path: impl Into<PathBuf>) -> Self {
        ElevationConfig { detail: true, file: RasterFile::from_path(path), site: MapSite::Middle }
    }

    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        self.file.validate().map_err(|e| e.under("file"))?;
        self.site.validate().map_err(|e| e.under("site"))
    }
}

impl OrthoimageConfig {
    /// The orthoimage in a file, with defaults for all else.
    pub fn from_path(path: impl Into<PathBuf>) -> Self {
        let file = RasterFile::from_path(path);
        OrthoimageConfig { values: AlbedoValues::Relative, detail: true, file, site: None }
    }

    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        self.file.validate().map_err(|e| e.under("file"))?;
        self.site.map_or(Ok(()), |site| site.validate()).map_err(|e| e.under("site"))
    }
}

impl RasterFile {
    /// A file that says all about itself.
    pub fn from_path(path: impl Into<PathBuf>) -> Self {
        RasterFile {
            path: path.into(),
            scale: 1.0,
            offset: 0.0,
            no_data: Vec::new(),
            radius_m: None,
            geometry: RasterGeometry::InFile,
            layout: None,
        }
    }

    fn validate(&self) -> Result<(), OutOfRange> {
        limits::finite("scale", &[self.scale])?;
        if self.scale == 0.0 {
            return Err(OutOfRange::new("scale", self.scale, "it must not be 0"));
        }
        limits::finite("offset", &[self.offset])?;
        limits::within("radius_m", self.radius_m.unwrap_or(1e6), 1e3, 1e9)?;
        match self.geometry {
            RasterGeometry::InFile => {}
            RasterGeometry::Metres { metres_per_px, first_x_m, first_y_m } => {
                limits::within("geometry.metres.metres_per_px", metres_per_px, 1e-3, 1e6)?;
                limits::finite("geometry.metres.first_x_m", &[first_x_m])?;
                limits::finite("geometry.metres.first_y_m", &[first_y_m])?;
            }
            RasterGeometry::Degrees { px_per_deg, first_longitude_deg, first_latitude_deg } => {
                limits::within("geometry.degrees.px_per_deg", px_per_deg, 1e-2, 1e7)?;
                limits::within("geometry.degrees.first_longitude_deg", first_longitude_deg, -360.0, 360.0)?;
                limits::within("geometry.degrees.first_latitude_deg", first_latitude_deg, -90.0, 90.0)?;
            }
        }
        self.layout.map_or(Ok(()), |layout| layout.validate()).map_err(|e| e.under("layout"))
    }
}
