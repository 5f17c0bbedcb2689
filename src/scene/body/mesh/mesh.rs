//! Triangle meshes.

use super::albedo::MeshAlbedo;
use nalgebra::Vector3;
use rayon::prelude::*;

/// A triangle mesh; faces run counter-clockwise seen from outside.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    /// Vertices in m, in the axes of the thing that the mesh is fixed to.
    pub vertices_m: Vec<Vector3<f64>>,
    /// Three vertex numbers a face.
    pub faces: Vec<[u32; 3]>,
    /// Albedo over the surface's mean (default: the same everywhere).
    pub albedo: MeshAlbedo,
}

impl Mesh {
    /// The three corners of a face, m.
    ///
    /// # Panics
    /// If the face names a vertex that the mesh does not have.
    pub fn corners_m(&self, face: &[u32; 3]) -> [Vector3<f64>; 3] {
        face.map(|vertex| self.vertices_m[vertex as usize])
    }

    /// Area of a face in m².
    pub fn face_area_m2(&self, face: &[u32; 3]) -> f64 {
        let [a, b, c] = self.corners_m(face);
        0.5 * (b - a).cross(&(c - a)).norm()
    }

    /// Numbers of the faces whose area is zero to rounding: less than 1e-12 of their longest edge squared.
    pub fn zero_area_faces(&self) -> Vec<usize> {
        let is_flat = |face: &[u32; 3]| {
            let [a, b, c] = self.corners_m(face);
            let longest = (b - a).norm_squared().max((c - b).norm_squared()).max((a - c).norm_squared());
            self.face_area_m2(face) <= 1e-12 * longest
        };
        self.faces.par_iter().enumerate().filter(|(_, face)| is_flat(face)).map(|(index, _)| index).collect()
    }

    /// Mean length of the faces' edges in m; 0 for a mesh without faces.
    pub fn mean_edge_m(&self) -> f64 {
        let perimeter = |face: &[u32; 3]| {
            let [a, b, c] = self.corners_m(face);
            (b - a).norm() + (c - b).norm() + (a - c).norm()
        };
        self.faces.iter().map(perimeter).sum::<f64>() / (3.0 * self.faces.len().max(1) as f64)
    }

    /// Distance in m of the farthest vertex from the origin.
    pub fn radius_m(&self) -> f64 {
        self.vertices_m.iter().map(|v| v.norm()).fold(0.0, f64::max)
    }

    /// Least and greatest coordinates in m.
    pub fn bounding_box(&self) -> [Vector3<f64>; 2] {
        let low = self.vertices_m.iter().fold(Vector3::repeat(f64::INFINITY), |low, v| low.inf(v));
        let high = self.vertices_m.iter().fold(Vector3::repeat(f64::NEG_INFINITY), |high, v| high.sup(v));
        [low, high]
    }

    /// Centre and radius in m of a sphere around the mesh: about the middle of its bounding box.
    pub fn bounding_sphere(&self) -> (Vector3<f64>, f64) {
        let [low, high] = self.bounding_box();
        let center_m = 0.5 * (low + high);
        (center_m, self.vertices_m.iter().map(|v| (v - center_m).norm()).fold(0.0, f64::max))
    }

    /// Adds another mesh's vertices and faces; its albedo is left out.
    pub fn append(&mut self, other: &Mesh) {
        let first = self.vertices_m.len() as u32;
        self.vertices_m.extend_from_slice(&other.vertices_m);
        self.faces.extend(other.faces.iter().map(|face| face.map(|vertex| first + vertex)));
    }

    /// The mesh moved by `shift_m`.
    pub fn translated(mut self, shift_m: &Vector3<f64>) -> Self {
        for vertex in &mut self.vertices_m {
            *vertex += shift_m;
        }
        if let MeshAlbedo::Globe(map) = &mut self.albedo {
            map.origin_m += shift_m;
        }
        self
    }
}
