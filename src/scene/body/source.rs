//! Where a small body's shape comes from.

use super::{MassProperties, Mesh, ProceduralBody};
use crate::scene::{SceneError, limits};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// A shape file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeshFile {
    /// OBJ file; a relative path starts at the folder of the scenario file.
    pub path: PathBuf,
    /// Metres in one unit of the file (default 1; 1000 for a file in kilometres).
    #[serde(default = "one")]
    pub metres_per_unit: f64,
}

fn one() -> f64 {
    1.0
}

/// Shape of a small body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
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
    /// The mesh with its centre of mass at the origin, and its mass properties there.
    ///
    /// # Errors
    /// Names the shape file and what is wrong with it.
    pub fn centered_mesh(&self, base_folder: &Path, seed: u64) -> Result<(Mesh, MassProperties), SceneError> {
        let (mesh, found) = match self {
            BodySource::Procedural(body) => {
                let mesh = body.mesh(seed);
                let found = mesh.mass_properties()?;
                (mesh, found)
            }
            BodySource::Mesh(file) => {
                let path = base_folder.join(&file.path);
                let mesh = Mesh::read_obj(&path, file.metres_per_unit)?;
                let found = mesh.mass_properties().map_err(|e| e.in_file(&path))?;
                (mesh, found)
            }
        };
        let at_origin = MassProperties { center_m: nalgebra::Vector3::zeros(), ..found };
        Ok((mesh.translated(&-found.center_m), at_origin))
    }

    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), SceneError> {
        match self {
            BodySource::Procedural(body) => body.validate().map_err(|e| e.under("procedural")),
            BodySource::Mesh(file) => limits::positive("mesh.metres_per_unit", file.metres_per_unit),
        }
    }
}
