//! Reading a shape file of any format.

use super::shape::{ShapeFault, ShapeFile};
use super::{obj, ply, stl};
use crate::scene::body::mesh::Mesh;
use crate::scene::error::SceneError;
use crate::settings::limits;
use std::path::Path;

impl Mesh {
    /// Reads a shape file: Wavefront OBJ, PLY (ASCII, little or big endian) or STL (ASCII or binary). The content tells
    /// PLY; the file's extension tells the others, and the content again where there is none that is known. Vertices at
    /// one place become one and polygons are cut into triangles; normals and materials are left out. Colours of a PLY
    /// file's vertices become the mesh's albedo.
    ///
    /// # Errors
    /// Names the file, and the line or face where there is one, of: a missing file, a file cut short, a coordinate that
    /// is not a finite number, a face that names a vertex that is not there, no faces at all, faces of zero area.
    pub fn read(path: &Path, metres_per_unit: f64) -> Result<Mesh, SceneError> {
        ShapeFile::read(path, metres_per_unit).map(|shape| shape.mesh)
    }
}

impl ShapeFile {
    /// As [`Mesh::read`], with texture coordinates.
    pub fn read(path: &Path, metres_per_unit: f64) -> Result<ShapeFile, SceneError> {
        limits::positive("metres_per_unit", metres_per_unit).map_err(|e| SceneError::from(e).in_file(path))?;
        let content = std::fs::read(path).map_err(|source| SceneError::Io {
            action: "read the shape",
            path: path.into(),
            source,
        })?;
        let shape = match format_of(path, &content) {
            Some(Format::Obj) => obj::read(&content, metres_per_unit),
            Some(Format::Ply) => ply::read(&content, metres_per_unit),
            Some(Format::Stl) => stl::read(content, metres_per_unit),
            None => Err(ShapeFault::Whole("it is no shape file: give one in OBJ, PLY or STL".into())),
        }
        .map_err(|fault| fault.in_file(path))?;
        check_places(&shape.mesh).map_err(|fault| fault.in_file(path))?;
        check_areas(&shape.mesh).map_err(|fault| fault.in_file(path))?;
        Ok(shape)
    }
}

enum Format {
    Obj,
    Ply,
    Stl,
}

fn format_of(path: &Path, content: &[u8]) -> Option<Format> {
    if content.starts_with(b"ply\n") || content.starts_with(b"ply\r") {
        return Some(Format::Ply);
    }
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    match extension.as_deref() {
        Some("obj") => Some(Format::Obj),
        Some("ply") => Some(Format::Ply),
        Some("stl") => Some(Format::Stl),
        _ if content.starts_with(b"solid") || stl::is_binary(content) => Some(Format::Stl),
        _ if content.starts_with(b"v ") || content.windows(3).any(|w| w == b"\nv ") => Some(Format::Obj),
        _ => None,
    }
}

/// Libraries read more than three numbers of a vertex in ways of their own, and a scale may overflow.
fn check_places(mesh: &Mesh) -> Result<(), ShapeFault> {
    let finite = |place: &nalgebra::Vector3<f64>| place.iter().all(|c| c.is_finite());
    match mesh.vertices_m.iter().position(|place| !finite(place)) {
        Some(index) => {
            let vertex = index + 1;
            Err(ShapeFault::Whole(format!(
                "vertex {vertex} is not at a finite place: give it three coordinates in range"
            )))
        }
        None => Ok(()),
    }
}

fn check_areas(mesh: &Mesh) -> Result<(), ShapeFault> {
    if mesh.faces.is_empty() {
        return Err(ShapeFault::Whole("it has no faces: is the file cut short?".into()));
    }
    if let flat @ [first, ..] = mesh.zero_area_faces().as_slice() {
        let (count, first) = (flat.len(), first + 1);
        let problem = format!("{count} faces have no area, the first is face {first}: remove them with a mesh editor");
        return Err(ShapeFault::Whole(problem));
    }
    Ok(())
}
