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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::TerrainConfig;
    use crate::stats::random_stream;
    use rand::RngExt;

    /// The column of a grid that a tile shares with the one beside it.
    fn border(vertices: &[TileVertex], side: usize, column: usize) -> Vec<TileVertex> {
        (0..side).map(|row| vertices[row * side + column]).collect()
    }

    #[test]
    fn tiles_side_by_side_share_their_vertices_to_the_last_bit() {
        let terrain = Terrain::new(&TerrainConfig::default(), 5);
        let mut random = random_stream(5, "neighbours", 0);
        for level in -8..=14 {
            for _ in 0..20 {
                let reach = (4000.0 / (32.0 * 2.0_f64.powi(level))).max(1.0) as i32;
                let [x, y] = [random.random_range(-reach..=reach), random.random_range(-reach..=reach)];
                let west = fitted_vertices(&TileKey { level, x, y }, &terrain);
                let east = fitted_vertices(&TileKey { level, x: x + 1, y }, &terrain);
                let (fine, coarse) = (SIDE * SIDE, COARSE_SIDE - 1);
                let shown = format!("level {level}, tile {x}, {y}");
                assert_eq!(border(&west, SIDE, SIDE - 1), border(&east, SIDE, 0), "{shown}");
                let [west, east] = [&west[fine..], &east[fine..]];
                assert_eq!(border(west, COARSE_SIDE, coarse), border(east, COARSE_SIDE, 0), "{shown}, coarser");
            }
        }
    }

    #[test]
    fn the_coarser_copy_is_the_coarser_tile_to_the_last_bit() {
        let terrain = Terrain::new(&TerrainConfig::default(), 5);
        let mut random = random_stream(5, "parents", 0);
        for level in -8..=13 {
            for _ in 0..20 {
                let reach = (4000.0 / (32.0 * 2.0_f64.powi(level))).max(1.0) as i32;
                let [x, y] = [random.random_range(-reach..=reach), random.random_range(-reach..=reach)];
                let child = fitted_vertices(&TileKey { level, x, y }, &terrain);
                let parent =
                    fitted_vertices(&TileKey { level: level + 1, x: x.div_euclid(2), y: y.div_euclid(2) }, &terrain);
                let first = [x, y].map(|c| c.rem_euclid(2) as usize * (COARSE_SIDE - 1));
                for (row, column) in (0..COARSE_SIDE).flat_map(|r| (0..COARSE_SIDE).map(move |c| (r, c))) {
                    let copy = child[SIDE * SIDE + row * COARSE_SIDE + column];
                    assert_eq!(
                        copy,
                        parent[(first[1] + row) * SIDE + first[0] + column],
                        "level {level}, tile {x}, {y}"
                    );
                }
            }
        }
    }
}
