//! Whether a point lies inside a closed mesh.

use crate::scene::Mesh;
use nalgebra::Vector3;
use rayon::prelude::*;

/// Whether the mesh surrounds the point: its winding number is nearer 1 than 0. Works for meshes with small holes.
///
/// Source: Jacobson, Kavan, Sorkine-Hornung, "Robust inside-outside segmentation using generalized winding numbers",
/// SIGGRAPH 2013; solid angle of a triangle by Van Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30 (1983).
pub(super) fn encloses(mesh: &Mesh, point_m: &Vector3<f64>) -> bool {
    // Fixed chunks, summed in order: the same answer whatever the number of threads.
    let parts: Vec<f64> = mesh
        .faces
        .par_chunks(4096)
        .map(|faces| faces.iter().map(|face| solid_angle(mesh, face, point_m)).sum())
        .collect();
    parts.iter().sum::<f64>().abs() > 2.0 * std::f64::consts::PI
}

fn solid_angle(mesh: &Mesh, face: &[u32; 3], point_m: &Vector3<f64>) -> f64 {
    let [a, b, c] = face.map(|i| mesh.vertices_m[i as usize] - point_m);
    let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
    let triple = a.dot(&b.cross(&c));
    let scale = la * lb * lc + a.dot(&b) * lc + b.dot(&c) * la + c.dot(&a) * lb;
    2.0 * triple.atan2(scale)
}
