//! Square tiles of terrain vertices, each of one level of a quadtree.

use crate::scene::{GroundDetail, GroundSample};

/// Vertices along a tile's edge: `SIDE` in `shaders/terrain_geometry.wgsl`.
pub(super) const SIDE: usize = 33;
/// Vertices along the edge of the coarser copy of a tile.
pub(super) const COARSE_SIDE: usize = 17;
/// Vertices of a tile, its coarser copy included.
pub(super) const TILE_VERTICES: usize = SIDE * SIDE + COARSE_SIDE * COARSE_SIDE;
/// Levels: the spacing of vertices is 2^level m.
pub(super) const FINEST_LEVEL: i32 = -8;
/// Four tiles of the coarsest level cover ±524 km: beyond the horizon from 12 km above Mars.
pub(super) const COARSEST_LEVEL: i32 = 14;
/// Relief and albedo of this many spacings and more are the vertices' to carry; finer ones are shaded per pixel:
/// `SHADE_SPACINGS` in `shaders/shading.wgsl`.
pub(super) const SHADE_SPACINGS: f64 = 8.0;
/// Relief of this many spacings and more displaces vertices.
const HEIGHT_SPACINGS: f64 = 1.0;
/// Features of this many spacings and more displace vertices.
const FEATURE_SPACINGS: f64 = 1.0;

/// Height in m, gradient by x and y, relative change of albedo.
pub(super) type TileVertex = [f32; 4];

/// Which tile.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct TileKey {
    pub level: i32,
    pub x: i32,
    pub y: i32,
}

impl TileKey {
    /// Spacing of vertices in m: a power of two, so that places of vertices are exact.
    pub(super) fn spacing_m(&self) -> f64 {
        2.0_f64.powi(self.level)
    }

    pub(super) fn edge_m(&self) -> f64 {
        (SIDE - 1) as f64 * self.spacing_m()
    }

    /// Corner with the least x and y, in the site frame, m.
    pub(super) fn corner_m(&self) -> [f64; 2] {
        [f64::from(self.x) * self.edge_m(), f64::from(self.y) * self.edge_m()]
    }

    pub(super) fn children(&self) -> [TileKey; 4] {
        let child = |dx, dy| TileKey { level: self.level - 1, x: 2 * self.x + dx, y: 2 * self.y + dy };
        [child(0, 0), child(1, 0), child(0, 1), child(1, 1)]
    }

    /// What this level's vertices show of the ground; smaller rocks stand on it ([`super::rocks`]).
    pub(super) fn detail(&self) -> GroundDetail {
        let spacing_m = self.spacing_m();
        GroundDetail {
            height_m: HEIGHT_SPACINGS * spacing_m,
            shade_m: SHADE_SPACINGS * spacing_m,
            feature_m: FEATURE_SPACINGS * spacing_m,
            rock_m: TILE_ROCK_SPACINGS * spacing_m,
            footprint_m: 0.0,
        }
    }
}

/// What the adapter reads of the ground at a vertex.
pub(super) fn tile_vertex(ground: &GroundSample) -> TileVertex {
    [ground.height_m as f32, ground.gradient.x as f32, ground.gradient.y as f32, ground.albedo_change as f32]
}

/// Rocks of this many spacings and more are a tile's own vertices' to show. They also are meshes up to twice as many, for the
/// tile's coarser copy leaves those out.
pub(super) const TILE_ROCK_SPACINGS: f64 = 16.0;
