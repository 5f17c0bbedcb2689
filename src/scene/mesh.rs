//! Triangle meshes.

use nalgebra::Vector3;

/// A triangle mesh; faces run counter-clockwise seen from outside.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    /// Vertices in m, in the axes of the thing that the mesh is fixed to.
    pub vertices_m: Vec<Vector3<f64>>,
    /// Three vertex numbers a face.
    pub faces: Vec<[u32; 3]>,
}
