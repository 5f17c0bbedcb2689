//! A unit sphere of nearly equal triangles.

use crate::scene::body::mesh::Mesh;
use nalgebra::Vector3;
use std::collections::HashMap;

impl Mesh {
    /// Icosahedron whose triangles are cut in four `subdivisions` times, on the unit sphere: 20·4ⁿ faces (n = 6 gives
    /// 81,920). Closed and outward.
    pub fn icosphere(subdivisions: u32) -> Mesh {
        let mut mesh = icosahedron();
        for _ in 0..subdivisions {
            mesh = quartered(&mesh);
        }
        mesh
    }
}

fn icosahedron() -> Mesh {
    let g = 0.5 * (1.0 + 5.0_f64.sqrt()); // golden ratio
    let corners = [
        (-1.0, g, 0.0),
        (1.0, g, 0.0),
        (-1.0, -g, 0.0),
        (1.0, -g, 0.0),
        (0.0, -1.0, g),
        (0.0, 1.0, g),
        (0.0, -1.0, -g),
        (0.0, 1.0, -g),
        (g, 0.0, -1.0),
        (g, 0.0, 1.0),
        (-g, 0.0, -1.0),
        (-g, 0.0, 1.0),
    ];
    #[rustfmt::skip]
    let faces = vec![
        [0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4], [11, 10, 2], [10, 7, 6],
        [7, 1, 8], [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9], [4, 9, 5], [2, 4, 11], [6, 2, 10],
        [8, 6, 7], [9, 8, 1],
    ];
    Mesh {
        vertices_m: corners.iter().map(|(x, y, z)| Vector3::new(*x, *y, *z).normalize()).collect(),
        faces,
        ..Mesh::default()
    }
}

fn quartered(mesh: &Mesh) -> Mesh {
    let mut vertices_m = mesh.vertices_m.clone();
    let mut middles: HashMap<(u32, u32), u32> = HashMap::new();
    let mut middle = |a: u32, b: u32| {
        *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
            vertices_m.push((vertices_m[a as usize] + vertices_m[b as usize]).normalize());
            (vertices_m.len() - 1) as u32
        })
    };
    let mut faces = Vec::with_capacity(4 * mesh.faces.len());
    for &[a, b, c] in &mesh.faces {
        let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
        faces.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
    }
    Mesh { vertices_m, faces, ..Mesh::default() }
}
