//! Rocks on terrain tiles: those too small for a tile's own vertices to show stand on it as meshes of their own.

use super::rock_mesh::RockMesh;
use super::tile::{TILE_ROCK_SPACINGS, TileKey, TileVertex, tile_vertex};
use crate::scene::{GroundDetail, Rock, Terrain, TerrainPatch};
use nalgebra::Vector2;

/// The smallest rocks that are drawn, in spacings.
const SMALLEST_SPACINGS: f64 = 0.5;
/// Rocks for each vertex of a tile: where there are more, an octave of diameters less is drawn. Rocks that cover a twentieth of
/// the ground stay below.
const MOST_ROCKS_A_VERTEX: f64 = 0.06;
/// How far the lower edge of a rock's skirt lies below the ground, in spacings.
const SUNK_SPACINGS: f64 = 0.25;
/// The ground below rocks that reach no farther than this many spacings is taken to be bilinear.
const BILINEAR_SPACINGS: f64 = 1.0;

/// A vertex of a rock: `RockVertex` in `shaders/terrain_geometry.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(super) struct RockVertex {
    /// The ground as the tile's vertices show it, and as those of the next coarser level do.
    pub ground: [TileVertex; 2],
    /// What the rock adds to it.
    pub rock: TileVertex,
    /// Place from the tile's corner in m, 1 where the coarser level does not show the rock, depth below the ground in m.
    pub place: [f32; 4],
}

/// Meshes of rocks whose centres lie in one tile.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct TileRocks {
    pub vertices: Vec<RockVertex>,
    /// Three a triangle.
    pub indices: Vec<u32>,
}

/// How far rocks may reach out of a tile of a spacing of vertices, in m.
pub(super) fn rock_reach_m(terrain: &Terrain, spacing_m: f64) -> f64 {
    let largest_m = terrain.largest_rock_m();
    if largest_m < SMALLEST_SPACINGS * spacing_m {
        return 0.0;
    }
    Rock::REACH_DIAMETERS * largest_m.min(2.0 * TILE_ROCK_SPACINGS * spacing_m)
}

/// Diameter in m of the smallest rocks that are drawn among vertices of a spacing in m.
fn smallest_rock_m(terrain: &Terrain, spacing_m: f64) -> f64 {
    let (mut smallest_m, mut number_1_m2) = (f64::INFINITY, 0.0);
    for (class_m, class_1_m2) in terrain.rock_numbers_1_m2() {
        number_1_m2 += class_1_m2;
        if class_m < SMALLEST_SPACINGS * spacing_m || number_1_m2 * spacing_m * spacing_m > MOST_ROCKS_A_VERTEX {
            break;
        }
        smallest_m = class_m;
    }
    smallest_m.min(terrain.largest_rock_m())
}

/// Rocks that stand on a tile as meshes.
pub(super) fn tile_rocks(key: &TileKey, terrain: &Terrain) -> TileRocks {
    let spacing_m = key.spacing_m();
    let corner_m = Vector2::from(key.corner_m());
    // Those that the coarser level does not show sink as the tile slides onto it.
    let smallest_m = [1.0, 2.0].map(|spacings| smallest_rock_m(terrain, spacings * spacing_m));
    let sizes_m = [smallest_m[0], 2.0 * TILE_ROCK_SPACINGS * spacing_m];
    let rocks = terrain.rocks_in(&corner_m, &corner_m.add_scalar(key.edge_m()), sizes_m);
    let mut made = TileRocks::default();
    if rocks.is_empty() {
        return made;
    }
    let (mut low_m, mut high_m) = (rocks[0].center_m(), rocks[0].center_m());
    for rock in &rocks {
        low_m = low_m.inf(&rock.center_m().add_scalar(-rock.reach_m()));
        high_m = high_m.sup(&rock.center_m().add_scalar(rock.reach_m()));
    }
    let coarser = TileKey { level: key.level + 1, ..*key };
    let between_rocks = |level: &TileKey| GroundDetail { rock_m: f64::INFINITY, ..level.detail() };
    let patches = [key, &coarser].map(|level| terrain.patch(&low_m, &high_m, &between_rocks(level)));
    for rock in &rocks {
        made.add(rock, (&corner_m, spacing_m), &patches, rock.diameter_m() < smallest_m[1]);
    }
    made
}

impl TileRocks {
    /// Heights in m of each vertex: the least and the greatest that either level's ground gives it.
    pub(super) fn heights_m(&self) -> impl Iterator<Item = [f32; 2]> {
        self.vertices.iter().map(|v| {
            let [fine, coarse] = v.ground.map(|ground| ground[0]);
            [fine.min(coarse) - v.place[3], fine.max(coarse) + v.rock[0]]
        })
    }

    /// Adds a rock to a tile with a corner (m) and a spacing of vertices (m), on the ground of both levels; `sinks` says
    /// whether the coarser one leaves it out.
    fn add(
        &mut self,
        rock: &Rock,
        (corner_m, spacing_m): (&Vector2<f64>, f64),
        patches: &[TerrainPatch; 2],
        sinks: bool,
    ) {
        let mesh = RockMesh::new(rock, spacing_m);
        let below =
            [RockFooting::new(rock, spacing_m, &patches[0]), RockFooting::new(rock, 2.0 * spacing_m, &patches[1])];
        let first = self.vertices.len();
        for at_m in mesh.places_m(rock) {
            let local_m = at_m - corner_m;
            let on_it = rock.sample(&at_m);
            self.vertices.push(RockVertex {
                ground: [below[0].at(&at_m), below[1].at(&at_m)],
                rock: [on_it.height_m, on_it.gradient.x, on_it.gradient.y, on_it.albedo].map(|c| c as f32),
                place: [local_m.x as f32, local_m.y as f32, f32::from(u8::from(sinks)), 0.0],
            });
        }
        let outline = self.vertices.len() - mesh.sides();
        self.vertices.extend_from_within(outline..);
        let skirt = outline + mesh.sides();
        self.vertices[skirt..].iter_mut().for_each(|v| v.place[3] = (SUNK_SPACINGS * spacing_m) as f32);
        self.indices.extend(mesh.triangles().flatten().map(|index| first as u32 + index));
    }
}

/// The ground below one rock.
enum RockFooting<'a> {
    Sampled(&'a TerrainPatch<'a>),
    /// Between the corners of a square with a corner and the inverse of its edge.
    Bilinear {
        low_m: Vector2<f64>,
        edge_1_m: f64,
        corners: [TileVertex; 4],
    },
}

impl<'a> RockFooting<'a> {
    fn new(rock: &Rock, spacing_m: f64, patch: &'a TerrainPatch<'a>) -> Self {
        let reach_m = rock.reach_m();
        if reach_m > BILINEAR_SPACINGS * spacing_m {
            return RockFooting::Sampled(patch);
        }
        let low_m = rock.center_m().add_scalar(-reach_m);
        let corner = |k: usize| {
            let at = low_m + Vector2::new((k & 1) as f64, (k >> 1) as f64) * (2.0 * reach_m);
            tile_vertex(&patch.sample(at.x, at.y))
        };
        RockFooting::Bilinear { low_m, edge_1_m: 0.5 / reach_m, corners: std::array::from_fn(corner) }
    }

    fn at(&self, at_m: &Vector2<f64>) -> TileVertex {
        match self {
            RockFooting::Sampled(patch) => tile_vertex(&patch.sample(at_m.x, at_m.y)),
            RockFooting::Bilinear { low_m, edge_1_m, corners: [a, b, c, d] } => {
                let part = ((at_m - low_m) * *edge_1_m).map(|p| p as f32);
                let along = |from: f32, to: f32, share: f32| from + (to - from) * share;
                let between = |k: usize| along(along(a[k], b[k], part.x), along(c[k], d[k], part.x), part.y);
                std::array::from_fn(between)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::TerrainConfig;

    /// Offsets of the ground below vertices of rocks from the ground that vertices of a level would show there, in spacings:
    /// bilinear below the smallest rocks, so that a scarp between may be missed.
    #[test]
    fn vertices_stand_on_the_ground_of_both_levels() {
        let terrain = Terrain::new(&TerrainConfig::default(), 5);
        for level in [-6, -4, -1] {
            let (mut offsets, mut from_corner) = (Vec::new(), Vec::new());
            for x in 40..80 {
                let key = TileKey { level, x, y: 9 };
                let corner_m = Vector2::from(key.corner_m());
                for vertex in tile_rocks(&key, &terrain).vertices {
                    let at_m = corner_m + Vector2::new(f64::from(vertex.place[0]), f64::from(vertex.place[1]));
                    for (ground, level) in vertex.ground.iter().zip([key.level, key.level + 1]) {
                        let level = TileKey { level, ..key };
                        let detail = GroundDetail { rock_m: f64::INFINITY, ..level.detail() };
                        let height_m = |at_m: &Vector2<f64>| terrain.sample(at_m.x, at_m.y, &detail).height_m;
                        offsets.push((f64::from(ground[0]) - height_m(&at_m)) / level.spacing_m());
                        from_corner.push((f64::from(ground[0]) - height_m(&corner_m)) / level.spacing_m());
                    }
                }
            }
            let rms = |v: &[f64]| (v.iter().map(|o| o * o).sum::<f64>() / v.len() as f64).sqrt();
            let (rms, control) = (rms(&offsets), rms(&from_corner));
            println!("level {level}: {rms:.3} spacings off, {control:.1} from the corner's height");
            assert!(offsets.len() > 200, "{} vertices of rocks at level {level}", offsets.len());
            assert!(rms < 0.1, "{rms} spacings off the ground at level {level}");
            assert!(control > 0.1, "the check cannot tell the ground from a plane");
        }
    }

    #[test]
    fn every_rock_stands_on_one_tile_or_is_carried_by_its_vertices() {
        let terrain = Terrain::new(&TerrainConfig::default(), 5);
        let parent = TileKey { level: -2, x: 3, y: 2 };
        let corner_m = Vector2::from(parent.corner_m());
        let of = |key: &TileKey, sizes_m| {
            let corner_m = Vector2::from(key.corner_m());
            terrain.rocks_in(&corner_m, &corner_m.add_scalar(key.edge_m()), sizes_m).len()
        };
        let sizes_m = [0.1, 3.0];
        let apart: usize = parent.children().iter().map(|child| of(child, sizes_m)).sum();
        assert!(apart > 10);
        assert_eq!(apart, of(&parent, sizes_m));
        let split = [[0.1, 0.5], [0.5, 3.0]].map(|sizes_m| of(&parent, sizes_m));
        assert_eq!(apart, split[0] + split[1], "by diameter, from {corner_m}");
    }
}
