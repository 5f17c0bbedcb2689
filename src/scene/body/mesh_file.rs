//! A shape file as a scenario names it.

use super::formats::ShapeFile;
use super::mesh::{AlbedoImage, ImageEdge, Mesh, MeshAlbedo};
use crate::scene::error::SceneError;
use crate::settings::{OutOfRange, limits};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Unit of a shape file's coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum LengthUnit {
    /// Metres.
    M,
    /// Kilometres.
    Km,
}

/// A shape file: OBJ, PLY or STL. Its scale must be said, by `unit` or by `metres_per_unit`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeshFile {
    /// The file; a relative path starts at the folder of the scenario file.
    pub path: PathBuf,
    /// Unit of the file's coordinates (default none: then `metres_per_unit` is required).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<LengthUnit>,
    /// Metres in one unit of the file, instead of `unit` (default none: then `unit` is required). It is taken at its word, whatever size of body it gives.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub metres_per_unit: Option<f64>,
    /// Image whose grey values are proportional to albedo (PNG, JPEG or TIFF), laid on by the texture coordinates of
    /// an OBJ file (default none). A relative path starts at the folder of the scenario file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub texture: Option<PathBuf>,
    /// Whether colours of a PLY file's vertices are its albedo (default true).
    #[serde(default = "yes")]
    pub vertex_colors: bool,
}

fn yes() -> bool {
    true
}

/// Radii of small bodies in m; beyond them a unit is probably wrong.
const PLAUSIBLE_RADIUS_M: (f64, f64) = (1.0, 1e6);

impl MeshFile {
    /// Metres in one unit of the file.
    ///
    /// # Errors
    /// Names the key if the scale is not said, said twice, or not a positive number.
    pub fn scale_m(&self) -> Result<f64, OutOfRange> {
        let fault = |value: &str, cure: &str| Err(OutOfRange::new("mesh.unit", value, cure));
        match (self.unit, self.metres_per_unit) {
            (Some(LengthUnit::M), None) => Ok(1.0),
            (Some(LengthUnit::Km), None) => Ok(1000.0),
            (None, Some(metres)) => limits::positive("mesh.metres_per_unit", metres).map(|()| metres),
            (None, None) => fault("missing", "say the unit of the shape file: unit = \"m\" or unit = \"km\""),
            (Some(_), Some(_)) => fault("given beside metres_per_unit", "drop one of them"),
        }
    }

    /// The mesh, in m.
    ///
    /// # Errors
    /// As [`Mesh::read`]; also names the key of the scale, and a texture that cannot be laid on.
    pub(super) fn read(&self, base_folder: &Path) -> Result<Mesh, SceneError> {
        let path = base_folder.join(&self.path);
        let ShapeFile { mut mesh, texture_corners } = ShapeFile::read(&path, self.scale_m()?)?;
        if !self.vertex_colors {
            mesh.albedo = MeshAlbedo::Uniform;
        }
        if let Some(texture) = &self.texture {
            let problem = "it has no texture coordinates for every face, so that no texture can be laid on: use an OBJ \
                           file with vt, or surface.albedo_map";
            let corners =
                texture_corners.ok_or_else(|| SceneError::Unusable { path: path.clone(), problem: problem.into() })?;
            let image = AlbedoImage::read(&base_folder.join(texture), ImageEdge::Repeat)?;
            mesh.albedo = MeshAlbedo::Texture { corners, image };
        }
        Ok(mesh)
    }

    /// Checks that the unit does not make the body absurdly small or large.
    ///
    /// # Errors
    /// Names the key, the radius and the unit to try.
    pub(super) fn check_size(&self, mesh: &Mesh) -> Result<(), OutOfRange> {
        let (Some(unit), (least_m, most_m)) = (self.unit, PLAUSIBLE_RADIUS_M) else { return Ok(()) };
        let (center_m, radius_m) = mesh.bounding_sphere();
        if (least_m..=most_m).contains(&radius_m) && center_m.norm() <= most_m {
            return Ok(());
        }
        let cure = format!(
            "the body would have a bounding radius of {radius_m:.3} m, which is absurd for a small body: is the file in {}? \
             If it is not, write metres_per_unit = {} instead of unit",
            if unit == LengthUnit::M { "kilometres" } else { "metres" },
            if unit == LengthUnit::M { 1 } else { 1000 },
        );
        let value = if unit == LengthUnit::M { "\"m\"" } else { "\"km\"" };
        Err(OutOfRange::new("mesh.unit", value, cure))
    }
}
