//! Heights of vertices for which the triangles between them lie on the ground on average.
//!
//! Triangles between vertices on the ground cut off crests and fill hollows: with a low Sun, shadows end too early. Over
//! a triangle whose sides span the second differences D₁, D₂, D₃ of a quadratic ground, the triangle lies above the ground
//! by (D₁ + D₂ + D₃) / 24 on average: the mean of each product of two barycentric coordinates is 1/12, and each side
//! counts half its second difference. Vertices are moved by as much the other way.

use super::tile::{COARSE_SIDE, SIDE, TILE_VERTICES, TileKey, TileVertex, tile_vertex};
use crate::scene::Terrain;
use nalgebra::Vector2;

/// Vertices of a tile row by row, then every other one as the next coarser level has it, all moved onto triangles that fit
/// the ground.
pub(super) fn fitted_vertices(key: &TileKey, terrain: &Terrain) -> Vec<TileVertex> {
    let mut vertices = Vec::with_capacity(TILE_VERTICES);
    let corner_m = Vector2::from(key.corner_m());
    add_fitted(terrain, &corner_m, (key, SIDE), &mut vertices);
    add_fitted(terrain, &corner_m, (&TileKey { level: key.level + 1, ..*key }, COARSE_SIDE), &mut vertices);
    vertices
}

/// Adds a square grid of vertices, `side` along each edge, with the spacing and the details of a level.
fn add_fitted(
    terrain: &Terrain,
    corner_m: &Vector2<f64>,
    (level, side): (&TileKey, usize),
    vertices: &mut Vec<TileVertex>,
) {
    let step_m = level.spacing_m();
    // With a ring around, as the tiles beside this one have it to the last bit.
    let width = side + 2;
    let low_m = corner_m.add_scalar(-step_m);
    let patch = terrain.patch(&low_m, &low_m.add_scalar((width - 1) as f64 * step_m), &level.detail());
    let at = |row: usize, column: usize| low_m + Vector2::new(column as f64, row as f64) * step_m;
    let places = (0..width).flat_map(|row| (0..width).map(move |column| at(row, column)));
    let ground: Vec<TileVertex> = places.map(|place_m| tile_vertex(&patch.sample(place_m.x, place_m.y))).collect();
    let height_m = |index: usize| f64::from(ground[index][0]);
    for middle in (1..=side).flat_map(|row| (1..=side).map(move |column| row * width + column)) {
        // Along the three directions of the triangles' sides.
        let around = [middle - 1, middle + 1, middle - width, middle + width, middle - width - 1, middle + width + 1];
        let differences_m: f64 = around.iter().map(|k| height_m(*k) - height_m(middle)).sum();
        let [_, by_x, by_y, albedo] = ground[middle];
        vertices.push([(height_m(middle) - differences_m / 24.0) as f32, by_x, by_y, albedo]);
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
