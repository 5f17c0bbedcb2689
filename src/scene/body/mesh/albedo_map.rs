//! A map of a body's albedo as a scenario names it.

use super::albedo::{GlobeMap, MeshAlbedo};
use super::albedo_image::{AlbedoImage, ImageEdge};
use super::mesh::Mesh;
use crate::scene::error::SceneError;
use crate::settings::{OutOfRange, limits};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// A simple cylindrical map: the whole sphere, east longitude to the right, north up.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AlbedoMapFile {
    /// PNG, JPEG or TIFF whose grey values are proportional to albedo; a relative path starts at the folder of the
    /// scenario file.
    pub path: PathBuf,
    /// East longitude of its left edge in degrees, -360 to 360 (default -180).
    #[serde(default = "date_line")]
    pub west_edge_deg: f64,
}

fn date_line() -> f64 {
    -180.0
}

impl AlbedoMapFile {
    /// Lays the map on a mesh, longitudes and latitudes counted about the origin of the mesh's axes.
    ///
    /// # Errors
    /// Names the image and what is wrong with it.
    pub(in crate::scene) fn lay_on(&self, mesh: &mut Mesh, base_folder: &Path) -> Result<(), SceneError> {
        let image = AlbedoImage::read(&base_folder.join(&self.path), ImageEdge::Clamp)?;
        let west_edge_rad = self.west_edge_deg.to_radians();
        mesh.albedo = MeshAlbedo::Globe(GlobeMap { image, west_edge_rad, origin_m: Vector3::zeros() });
        Ok(())
    }

    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::within("west_edge_deg", self.west_edge_deg, -360.0, 360.0)
    }
}
