//! Heights of vertices for which the triangles between them lie on the ground on average.
//!
//! Triangles between vertices on the ground cut off crests and fill hollows: with a low Sun, shadows end too early. Over
//! a triangle whose sides span the second differences D₁, D₂, D₃ of a quadratic ground, the triangle lies above the ground
//! by (D₁ + D₂ + D₃) / 24 on average: the mean of each product of two barycentric coordinates is 1/12, and each side
//! counts half its second difference. Vertices are moved by as much the other way.

use super::terrain_tile::{COARSE_SIDE, SIDE, TileKey, TileVertex};
use crate::scene::{GroundDetail, Terrain};
use nalgebra::Vector2;

/// A grid of a tile's vertices.
struct Lattice {
    corner_m: Vector2<f64>,
    side: usize,
    step_m: f64,
    detail: GroundDetail,
}

/// Vertices of a tile, those of its coarser copy included, moved onto triangles that fit the ground.
pub(super) fn fitted_vertices(key: &TileKey, terrain: &Terrain) -> Vec<TileVertex> {
    let mut vertices = key.vertices(terrain);
    let coarser = TileKey { level: key.level + 1, ..*key };
    let corner_m = Vector2::from(key.corner_m());
    let (fine, coarse) = vertices.split_at_mut(SIDE * SIDE);
    Lattice { corner_m, side: SIDE, step_m: key.spacing_m(), detail: key.detail() }.fit(terrain, fine);
    Lattice { corner_m, side: COARSE_SIDE, step_m: coarser.spacing_m(), detail: coarser.detail() }.fit(terrain, coarse);
    vertices
}

impl Lattice {
    fn fit(&self, terrain: &Terrain, vertices: &mut [TileVertex]) {
        let heights_m = self.with_ring(terrain, vertices);
        let width = self.side + 2;
        for (index, vertex) in vertices.iter_mut().enumerate() {
            let at = (index / self.side + 1) * width + index % self.side + 1;
            // Along the three directions of the triangles' sides.
            let around = [at - 1, at + 1, at - width, at + width, at - width - 1, at + width + 1];
            let differences_m: f64 = around.iter().map(|k| heights_m[*k] - heights_m[at]).sum();
            vertex[0] = (heights_m[at] - differences_m / 24.0) as f32;
        }
    }

    /// Heights of the vertices in m and of a ring around them, as tiles beside this one have them to the last bit.
    fn with_ring(&self, terrain: &Terrain, vertices: &[TileVertex]) -> Vec<f64> {
        let (side, edge_m) = (self.side, (self.side - 1) as f64 * self.step_m);
        let (low_m, high_m) = (self.corner_m.add_scalar(-self.step_m), self.corner_m.add_scalar(edge_m + self.step_m));
        let patch = terrain.patch(&low_m, &high_m, &self.detail);
        let height_m = |row: usize, column: usize| {
            if (1..=side).contains(&row) && (1..=side).contains(&column) {
                return f64::from(vertices[(row - 1) * side + column - 1][0]);
            }
            let place_m = low_m + Vector2::new(column as f64, row as f64) * self.step_m;
            f64::from(patch.sample(place_m.x, place_m.y).height_m as f32)
        };
        (0..side + 2)
            .flat_map(|row| (0..side + 2).map(move |column| (row, column)))
            .map(|(r, c)| height_m(r, c))
            .collect()
    }
}
