//! Draws terrain tiles and the rocks on them (`shaders/terrain_geometry.wgsl`).

use super::level_of_detail::{LevelRange, ViewVolume, choose_tiles};
use super::pipelines::Drawn;
use super::rock_pages::BOOK;
use super::rocks::rock_reach_m;
use super::tile::{SIDE, TileKey};
use super::tile_pool::TilePool;
use crate::render::error::RenderError;
use crate::render::gpu::{Geometry, Gpu, Role, Tile, buffer};
use crate::scene::{Terrain, View};
use nalgebra::{Vector2, Vector3};
use std::ops::Range;
use wgpu::util::DeviceExt;

/// Least height above the ground in m.
const LEAST_CLEARANCE_M: f64 = 0.02;
/// Indices of rocks for which there is room at first.
const FIRST_ROCK_INDICES: usize = 1 << 16;

/// What is known of the tiles of a view.
#[derive(Debug, Clone, Copy)]
pub struct DrawnTiles {
    /// Heights in m of the lowest and the highest vertex.
    pub height_range_m: [f64; 2],
    /// The same of what the image may show.
    pub seen_range_m: [f64; 2],
}

#[derive(Debug)]
pub struct TerrainGeometry {
    terrain: Terrain,
    pool: TilePool,
    uniforms: [wgpu::Buffer; 2],
    ground: Drawn,
    rocks: Drawn,
    /// Of one tile, and of all rocks.
    indices: [wgpu::Buffer; 2],
    /// Tiles that the image and the shadow map show: the first ones.
    tile_counts: [u32; 2],
    /// The same for indices of rocks, in each buffer of rocks.
    rock_ranges: Vec<[Range<u32>; 2]>,
}

impl TerrainGeometry {
    pub fn new(gpu: &Gpu, terrain: &Terrain) -> Self {
        let pool = TilePool::new(gpu);
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let uniforms = [0, 1].map(|_| buffer(gpu, size_of::<Geometry>() as u64, usage));
        let mut ground = Drawn::new(gpu, ["vertex", "shadow_vertex"]);
        ground.bind(gpu, &uniforms, std::iter::once(pool.buffer()), pool.capacity());
        let rocks = Drawn::new(gpu, ["rock_vertex", "rock_shadow_vertex"]);
        let tile_indices = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("tile indices"),
            contents: bytemuck::cast_slice(&tile_indices()),
            usage: wgpu::BufferUsages::INDEX,
        });
        TerrainGeometry {
            terrain: terrain.clone(),
            pool,
            uniforms,
            ground,
            rocks,
            indices: [tile_indices, index_buffer(gpu, FIRST_ROCK_INDICES)],
            tile_counts: [0; 2],
            rock_ranges: Vec::new(),
        }
    }

    /// What is drawn.
    pub fn terrain(&self) -> &Terrain {
        &self.terrain
    }

    /// Height of the camera above the ground beneath it, in m.
    pub fn check_view(&self, view: &View) -> Result<f64, RenderError> {
        let camera = view.reference_from_camera.translation.vector;
        let clearance_m = camera.z - self.terrain.height_m(camera.x, camera.y);
        if clearance_m < LEAST_CLEARANCE_M {
            return Err(RenderError::CameraBelowGround { t_ns: view.t_ns, clearance_m, least_m: LEAST_CLEARANCE_M });
        }
        if view.sun_in_reference.z <= 0.0 {
            return Err(RenderError::SunBelowHorizon { t_ns: view.t_ns });
        }
        Ok(clearance_m)
    }

    /// A corner of the metre grid near the camera: places of vertices from here are exact in f32.
    pub fn anchor_m(camera_in_site_m: &Vector3<f64>) -> Vector2<f64> {
        camera_in_site_m.xy().map(f64::round)
    }

    /// Brings the tiles of a view onto the adapter.
    pub fn prepare(&mut self, gpu: &Gpu, volume: &ViewVolume, levels: &LevelRange) -> Result<DrawnTiles, RenderError> {
        let keys = choose_tiles(&self.terrain, volume, levels);
        let capacity = self.pool.capacity();
        let slots = self.pool.place(gpu, &self.terrain, &keys)?;
        let shows = |key: &TileKey| {
            let reach_m = rock_reach_m(&self.terrain, key.spacing_m());
            volume.shows_tile(key, self.pool.heights_m(key), reach_m)
        };
        let (seen, unseen): (Vec<_>, Vec<_>) = keys.iter().zip(slots).partition(|(key, _)| shows(key));
        if capacity != self.pool.capacity() {
            self.ground.bind(gpu, &self.uniforms, std::iter::once(self.pool.buffer()), self.pool.capacity());
        }
        if capacity != self.pool.capacity() || self.pool.rocks().buffers().len() != self.rocks.parts() {
            self.rocks.bind(gpu, &self.uniforms, self.pool.rocks().buffers(), BOOK);
        }
        let anchor_m = Self::anchor_m(&volume.camera_in_site_m);
        let tiles: Vec<Tile> = seen.iter().chain(&unseen).map(|(key, slot)| tile(key, *slot, &anchor_m)).collect();
        self.ground.place(gpu, 0, &tiles);
        self.tile_counts = [seen.len(), tiles.len()].map(|count| count as u32);
        self.place_rocks(gpu, (&keys_of(&seen), &keys_of(&unseen)), &anchor_m);
        Ok(DrawnTiles {
            height_range_m: self.pool.height_range_m(keys.iter()),
            seen_range_m: self.pool.height_range_m(seen.iter().map(|(key, _)| *key)),
        })
    }

    pub fn set_geometry(&self, gpu: &Gpu, role: Role, geometry: &Geometry) {
        gpu.queue.write_buffer(&self.uniforms[role as usize], 0, bytemuck::bytes_of(geometry));
    }

    /// Says where the rocks of tiles lie, and which of them are drawn.
    fn place_rocks(&mut self, gpu: &Gpu, (seen, unseen): (&[TileKey], &[TileKey]), anchor_m: &Vector2<f64>) {
        let mut indices: Vec<u32> = Vec::new();
        self.rock_ranges.clear();
        for book in 0..self.rocks.parts() {
            let mut places = vec![Tile { base: [0.0; 2], spacing: 1.0, slot: 0 }; BOOK];
            let first = indices.len() as u32;
            let mut add = |keys: &[TileKey]| {
                let found = keys.iter().map(|key| (key, self.pool.rocks_of(key)));
                for (key, rocks) in found.filter(|(_, rocks)| rocks.book == book) {
                    rocks.pages.iter().for_each(|page| places[*page as usize] = tile(key, 0, anchor_m));
                    indices.extend(&rocks.indices);
                }
                first..indices.len() as u32
            };
            self.rock_ranges.push([add(seen), add(unseen)]);
            self.rocks.place(gpu, book, &places);
        }
        if self.indices[1].size() < size_of_val(&indices[..]) as u64 {
            self.indices[1] = index_buffer(gpu, indices.len().next_power_of_two());
        }
        gpu.queue.write_buffer(&self.indices[1], 0, bytemuck::cast_slice(&indices));
    }

    pub fn draw(&self, pass: &mut wgpu::RenderPass, role: Role) {
        self.ground.set(pass, role, 0);
        pass.set_index_buffer(self.indices[0].slice(..), wgpu::IndexFormat::Uint16);
        pass.draw_indexed(0..(6 * (SIDE - 1) * (SIDE - 1)) as u32, 0, 0..self.tile_counts[role as usize]);
        pass.set_index_buffer(self.indices[1].slice(..), wgpu::IndexFormat::Uint32);
        for (book, ranges) in self.rock_ranges.iter().enumerate() {
            let range = ranges[role as usize].clone();
            if !range.is_empty() {
                self.rocks.set(pass, role, book);
                pass.draw_indexed(range, 0, 0..1);
            }
        }
    }
}

fn keys_of(tiles: &[(&TileKey, u32)]) -> Vec<TileKey> {
    tiles.iter().map(|(key, _)| **key).collect()
}

fn tile(key: &TileKey, slot: u32, anchor_m: &Vector2<f64>) -> Tile {
    let [x_m, y_m] = key.corner_m();
    Tile { base: [(x_m - anchor_m.x) as f32, (y_m - anchor_m.y) as f32], spacing: key.spacing_m() as f32, slot }
}

fn index_buffer(gpu: &Gpu, count: usize) -> wgpu::Buffer {
    let usage = wgpu::BufferUsages::INDEX | wgpu::BufferUsages::COPY_DST;
    buffer(gpu, (size_of::<u32>() * count) as u64, usage)
}

/// Two triangles a cell, counter-clockwise from above; all diagonals run the same way, as those of the coarser grid do.
fn tile_indices() -> Vec<u16> {
    let cells = (0..SIDE - 1).flat_map(|j| (0..SIDE - 1).map(move |i| j * SIDE + i));
    cells.flat_map(|a| [a, a + 1, a + SIDE + 1, a, a + SIDE + 1, a + SIDE]).map(|index| index as u16).collect()
}
