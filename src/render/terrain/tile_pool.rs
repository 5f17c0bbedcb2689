//! Terrain tiles on the adapter, kept from frame to frame.

use super::rock_pages::{PagedRocks, RockPages};
use super::rocks::{TileRocks, tile_rocks};
use super::tile::{TILE_VERTICES, TileKey, TileVertex};
use super::vertex_heights::fitted_vertices;
use crate::render::error::RenderError;
use crate::render::gpu::{Gpu, buffer};
use crate::scene::Terrain;
use rayon::prelude::*;
use std::collections::HashMap;

const TILE_BYTES: u64 = (TILE_VERTICES * size_of::<TileVertex>()) as u64;
const FIRST_CAPACITY: usize = 2048;

#[derive(Debug)]
struct Slot {
    index: u32,
    last_used: u64,
    /// Heights of the lowest and the highest vertex.
    heights_m: [f32; 2],
    rocks: PagedRocks,
}

/// A pool of tiles and the rocks on them; the tile not used for longest makes room.
#[derive(Debug)]
pub(super) struct TilePool {
    buffer: wgpu::Buffer,
    capacity: usize,
    rocks: RockPages,
    slots: HashMap<TileKey, Slot>,
    free: Vec<u32>,
    frame: u64,
}

impl TilePool {
    pub(super) fn new(gpu: &Gpu) -> Self {
        TilePool::with_capacity(gpu, FIRST_CAPACITY)
    }

    fn with_capacity(gpu: &Gpu, capacity: usize) -> Self {
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
        TilePool {
            buffer: buffer(gpu, TILE_BYTES * capacity as u64, usage),
            capacity,
            rocks: RockPages::default(),
            slots: HashMap::new(),
            free: (0..capacity as u32).rev().collect(),
            frame: 0,
        }
    }

    pub(super) fn buffer(&self) -> &wgpu::Buffer {
        &self.buffer
    }

    /// Tiles that the pool holds at once.
    pub(super) fn capacity(&self) -> usize {
        self.capacity
    }

    /// Where the rocks' vertices are.
    pub(super) fn rocks(&self) -> &RockPages {
        &self.rocks
    }

    /// Rocks on a tile that is present.
    pub(super) fn rocks_of(&self, key: &TileKey) -> &PagedRocks {
        &self.slots[key].rocks
    }

    /// Makes all `keys` present and returns their slots. The buffer is a new one, and there are more of rocks, if they did
    /// not fit.
    pub(super) fn place(&mut self, gpu: &Gpu, terrain: &Terrain, keys: &[TileKey]) -> Result<Vec<u32>, RenderError> {
        if keys.len() > self.capacity {
            let limit = gpu.device.limits().max_storage_buffer_binding_size;
            let capacity = capacity(keys.len(), limit).ok_or_else(|| {
                gpu.error(
                    "hold the terrain of this view",
                    format!("{} tiles are too many: raise render.vertex_spacing_px", keys.len()),
                )
            })?;
            *self = TilePool::with_capacity(gpu, capacity);
        }
        self.frame += 1;
        let missing: Vec<TileKey> = keys.iter().filter(|key| !self.touch(key)).copied().collect();
        let made: Vec<(Vec<TileVertex>, TileRocks)> =
            missing.par_iter().map(|key| (fitted_vertices(key, terrain), tile_rocks(key, terrain))).collect();
        let pages = made.iter().map(|(_, rocks)| RockPages::needed(rocks)).sum();
        self.make_room(missing.len(), pages);
        for (key, (vertices, rocks)) in missing.iter().zip(&made) {
            let heights_m = range(vertices.iter().map(|vertex| [vertex[0]; 2]).chain(rocks.heights_m()));
            let rocks = self.rocks.place(gpu, rocks)?;
            let index = self.free.pop().expect("room was made for every tile");
            gpu.queue.write_buffer(&self.buffer, TILE_BYTES * u64::from(index), bytemuck::cast_slice(vertices));
            self.slots.insert(*key, Slot { index, last_used: self.frame, heights_m, rocks });
        }
        Ok(keys.iter().map(|key| self.slots[key].index).collect())
    }

    /// Heights in m of the lowest and the highest vertex of a tile that is present.
    pub(super) fn heights_m(&self, key: &TileKey) -> [f64; 2] {
        self.slots[key].heights_m.map(f64::from)
    }

    /// Heights in m of the lowest and the highest vertex of tiles that are present.
    pub(super) fn height_range_m<'a>(&self, keys: impl Iterator<Item = &'a TileKey>) -> [f64; 2] {
        range(keys.map(|key| self.slots[key].heights_m)).map(f64::from)
    }

    fn touch(&mut self, key: &TileKey) -> bool {
        match self.slots.get_mut(key) {
            Some(slot) => {
                slot.last_used = self.frame;
                true
            }
            None => false,
        }
    }

    /// Has idle tiles leave until there is room for tiles, and for pages of rocks in the buffers that are kept.
    fn make_room(&mut self, tiles: usize, pages: usize) {
        let mut idle: Vec<(u64, u32, TileKey)> = self
            .slots
            .iter()
            .filter(|(_, slot)| slot.last_used < self.frame)
            .map(|(key, slot)| (slot.last_used, slot.index, *key))
            .collect();
        idle.sort_unstable_by_key(|(last_used, index, _)| (*last_used, *index));
        for (_, index, key) in idle {
            if self.free.len() >= tiles && self.rocks.has_room(pages) {
                break;
            }
            if let Some(slot) = self.slots.remove(&key) {
                self.rocks.release(&slot.rocks);
            }
            self.free.push(index);
        }
    }
}

/// The range that holds all ranges; from ∞ to -∞ without any.
/// Tiles to make room for where `tiles` have to fit into `limit` bytes: more than these, so that room is seldom made anew.
/// `None` if they do not fit.
fn capacity(tiles: usize, limit: u64) -> Option<usize> {
    let most = (limit / TILE_BYTES) as usize;
    (tiles <= most).then(|| tiles.next_power_of_two().min(most))
}

fn range(ranges: impl Iterator<Item = [f32; 2]>) -> [f32; 2] {
    let wider = |[low, high]: [f32; 2], other: [f32; 2]| [low.min(other[0]), high.max(other[1])];
    ranges.fold([f32::INFINITY, f32::NEG_INFINITY], wider)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_buffer_is_used_up_to_its_last_tile() {
        let limit = 1000 * TILE_BYTES + 1;
        assert_eq!(capacity(300, limit), Some(512));
        assert_eq!(capacity(512, limit), Some(512));
        assert_eq!(capacity(513, limit), Some(1000));
        assert_eq!(capacity(1000, limit), Some(1000));
        assert_eq!(capacity(1001, limit), None);
    }
}
