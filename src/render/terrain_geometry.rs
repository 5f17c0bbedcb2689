//! Draws terrain tiles (`shaders/terrain_geometry.wgsl`).

use super::geometry_pass::{GeometryKind, GeometryPipelines, Role, buffer, storage_entry, uniform_entry};
use super::gpu_data::{Geometry, Tile};
use super::terrain_levels::{LevelRange, ViewVolume, choose_tiles};
use super::terrain_pool::TilePool;
use super::terrain_tile::{SIDE, TileKey};
use super::{Gpu, RenderError};
use crate::scene::{Terrain, View};
use nalgebra::{Vector2, Vector3};
use wgpu::util::DeviceExt;

/// Least height above the ground in m.
const LEAST_CLEARANCE_M: f64 = 0.02;

/// The picture shows both sides: slivers of vertices that have nearly slid onto each other face either way by rounding, and
/// none may be missing. The shadow map leaves out the ground that faces the Sun (its right and up and the direction of light
/// are right-handed, so that it shows triangles mirrored): light that something keeps from ground has entered what keeps it
/// away by a side that faces away from the Sun, and without the other side lit ground cannot shadow itself (after Wang and
/// Molnar, "Second-depth shadow mapping", 1994).
const CULLED: [Option<wgpu::Face>; 2] = [None, Some(wgpu::Face::Back)];

/// What is known of the tiles of a view.
#[derive(Debug, Clone, Copy)]
pub(super) struct DrawnTiles {
    /// Heights in m of the lowest and the highest vertex.
    pub height_range_m: [f64; 2],
    /// The same of what the picture may show.
    pub seen_range_m: [f64; 2],
}

#[derive(Debug)]
pub(super) struct TerrainGeometry {
    terrain: Terrain,
    pipelines: GeometryPipelines,
    pool: TilePool,
    uniforms: [wgpu::Buffer; 2],
    tiles: wgpu::Buffer,
    groups: [wgpu::BindGroup; 2],
    indices: wgpu::Buffer,
    /// Tiles that the picture and the shadow map show: the first ones.
    tile_counts: [u32; 2],
}

impl TerrainGeometry {
    pub(super) fn new(gpu: &Gpu, terrain: &Terrain) -> Self {
        let kind = GeometryKind {
            source: include_str!("../../shaders/terrain_geometry.wgsl"),
            entries: ["vertex", "fragment"],
            shadow_entry: "shadow_vertex",
            buffers: &[],
            bindings: &[uniform_entry(0, wgpu::ShaderStages::VERTEX), storage_entry(1), storage_entry(2)],
            culled: CULLED,
        };
        let pipelines = GeometryPipelines::new(gpu, &kind);
        let pool = TilePool::new(gpu);
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let uniforms = [0, 1].map(|_| buffer(gpu, size_of::<Geometry>() as u64, usage));
        let tiles = tile_buffer(gpu, &pool);
        let groups = bind(gpu, &pipelines, [&uniforms[0], &uniforms[1]], [&tiles, pool.buffer()]);
        let indices = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("tile indices"),
            contents: bytemuck::cast_slice(&tile_indices()),
            usage: wgpu::BufferUsages::INDEX,
        });
        TerrainGeometry {
            terrain: terrain.clone(),
            pipelines,
            pool,
            uniforms,
            tiles,
            groups,
            indices,
            tile_counts: [0; 2],
        }
    }

    /// What is drawn.
    pub(super) fn terrain(&self) -> &Terrain {
        &self.terrain
    }

    /// Height of the camera above the ground beneath it, in m.
    pub(super) fn check_view(&self, view: &View) -> Result<f64, RenderError> {
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
    pub(super) fn anchor_m(camera_in_site_m: &Vector3<f64>) -> Vector2<f64> {
        camera_in_site_m.xy().map(f64::round)
    }

    /// Brings the tiles of a view onto the adapter.
    pub(super) fn prepare(
        &mut self,
        gpu: &Gpu,
        volume: &ViewVolume,
        levels: &LevelRange,
    ) -> Result<DrawnTiles, RenderError> {
        let keys = choose_tiles(&self.terrain, volume, levels);
        let capacity = self.pool.capacity();
        let slots = self.pool.place(gpu, &self.terrain, &keys)?;
        let (seen, unseen): (Vec<_>, Vec<_>) =
            keys.iter().zip(slots).partition(|(key, _)| volume.shows_tile(key, self.pool.heights_m(key)));
        if self.pool.capacity() != capacity {
            self.tiles = tile_buffer(gpu, &self.pool);
            let uniforms = [&self.uniforms[0], &self.uniforms[1]];
            self.groups = bind(gpu, &self.pipelines, uniforms, [&self.tiles, self.pool.buffer()]);
        }
        let anchor_m = Self::anchor_m(&volume.camera_in_site_m);
        let tiles: Vec<Tile> = seen.iter().chain(&unseen).map(|(key, slot)| tile(key, *slot, &anchor_m)).collect();
        gpu.queue.write_buffer(&self.tiles, 0, bytemuck::cast_slice(&tiles));
        self.tile_counts = [seen.len(), tiles.len()].map(|count| count as u32);
        Ok(DrawnTiles {
            height_range_m: self.pool.height_range_m(keys.iter()),
            seen_range_m: self.pool.height_range_m(seen.iter().map(|(key, _)| *key)),
        })
    }

    pub(super) fn set_geometry(&self, gpu: &Gpu, role: Role, geometry: &Geometry) {
        gpu.queue.write_buffer(&self.uniforms[role as usize], 0, bytemuck::bytes_of(geometry));
    }

    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass, role: Role) {
        pass.set_pipeline(self.pipelines.of(role));
        pass.set_bind_group(0, &self.groups[role as usize], &[]);
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint16);
        pass.draw_indexed(0..(6 * (SIDE - 1) * (SIDE - 1)) as u32, 0, 0..self.tile_counts[role as usize]);
    }
}

fn tile(key: &TileKey, slot: u32, anchor_m: &Vector2<f64>) -> Tile {
    let [x_m, y_m] = key.corner_m();
    Tile { base: [(x_m - anchor_m.x) as f32, (y_m - anchor_m.y) as f32], spacing: key.spacing_m() as f32, slot }
}

fn tile_buffer(gpu: &Gpu, pool: &TilePool) -> wgpu::Buffer {
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
    buffer(gpu, (size_of::<Tile>() * pool.capacity()) as u64, usage)
}

fn bind(
    gpu: &Gpu,
    pipelines: &GeometryPipelines,
    uniforms: [&wgpu::Buffer; 2],
    storage: [&wgpu::Buffer; 2],
) -> [wgpu::BindGroup; 2] {
    [Role::Picture, Role::Shadow].map(|role| {
        let buffers = [uniforms[role as usize], storage[0], storage[1]];
        let entries: Vec<_> = (0..)
            .zip(buffers)
            .map(|(binding, b)| wgpu::BindGroupEntry { binding, resource: b.as_entire_binding() })
            .collect();
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("terrain geometry"),
            layout: &pipelines.of(role).get_bind_group_layout(0),
            entries: &entries,
        })
    })
}

/// Two triangles a cell, counter-clockwise from above; all diagonals run the same way, as those of the coarser grid do.
fn tile_indices() -> Vec<u16> {
    let cells = (0..SIDE - 1).flat_map(|j| (0..SIDE - 1).map(move |i| j * SIDE + i));
    cells.flat_map(|a| [a, a + 1, a + SIDE + 1, a, a + SIDE + 1, a + SIDE]).map(|index| index as u16).collect()
}
