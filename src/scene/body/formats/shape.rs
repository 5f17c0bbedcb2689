//! Shapes from files: OBJ, PLY and STL.

use crate::scene::body::mesh::Mesh;
use crate::scene::error::SceneError;
use std::path::Path;

/// What a shape file holds.
#[derive(Default)]
pub struct ShapeFile {
    /// The mesh, in m.
    pub mesh: Mesh,
    /// Texture coordinates of the three corners of each face: u to the right and v up, 0 to 1 over the image.
    pub texture_corners: Option<Vec<[[f32; 2]; 3]>>,
}

/// What a format's reader finds wrong.
pub(super) enum ShapeFault {
    /// At a line from 1.
    Line(usize, String),
    /// In the file as a whole.
    Whole(String),
}

impl From<String> for ShapeFault {
    fn from(problem: String) -> Self {
        ShapeFault::Whole(problem)
    }
}

impl ShapeFault {
    pub(super) fn in_file(self, path: &Path) -> SceneError {
        match self {
            ShapeFault::Line(line, problem) => SceneError::Malformed { path: path.into(), line: line as u64, problem },
            ShapeFault::Whole(problem) => SceneError::Unusable { path: path.into(), problem },
        }
    }
}
