//! Where a small body's shape comes from.

use super::mesh::{AlbedoMapFile, MassProperties, Mesh};
use super::mesh_file::MeshFile;
use super::procedural::ProceduralBody;
use crate::scene::error::SceneError;
use crate::settings::OutOfRange;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Shape of a small body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub enum BodySource {
    /// Made from a seed.
    Procedural(ProceduralBody),
    /// Read from a file.
    Mesh(MeshFile),
}

impl Default for BodySource {
    fn default() -> Self {
        BodySource::Procedural(ProceduralBody::default())
    }
}

impl BodySource {
    /// The mesh with its centre of mass at the origin, and its mass properties there; the map is laid on, if there is one.
    ///
    /// # Errors
    /// Names the shape file or the image and what is wrong with it.
    pub fn centered_mesh(
        &self,
        albedo_map: Option<&AlbedoMapFile>,
        base_folder: &Path,
        seed: u64,
    ) -> Result<(Mesh, MassProperties), SceneError> {
        let (mut mesh, found) = match self {
            BodySource::Procedural(body) => {
                let mesh = body.mesh(seed);
                let found = mesh.mass_properties()?;
                (mesh, found)
            }
            BodySource::Mesh(file) => {
                let mesh = file.read(base_folder)?;
                let path = base_folder.join(&file.path);
                let found = mesh.mass_properties().map_err(|e| e.in_file(&path))?;
                file.check_size(&mesh).map_err(|e| SceneError::from(e.under("shape")).in_file(&path))?;
                (mesh, found)
            }
        };
        if let Some(map) = albedo_map {
            map.lay_on(&mut mesh, base_folder)?;
        }
        let at_origin = MassProperties { center_m: nalgebra::Vector3::zeros(), ..found };
        Ok((mesh.with_mean_albedo_1().translated(&-found.center_m), at_origin))
    }

    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        match self {
            BodySource::Procedural(body) => body.validate().map_err(|e| e.under("procedural")),
            BodySource::Mesh(file) => file.scale_m().map(|_| ()),
        }
    }
}
