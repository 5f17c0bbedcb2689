//! Vertices of rocks on the adapter, in pages of one tile each.

use super::geometry_pass::buffer;
use super::terrain_rocks::{RockVertex, TileRocks};
use super::{Gpu, RenderError};

/// Vertices of a page: `PAGE` in `shaders/terrain_geometry.wgsl`.
const PAGE: usize = 256;
const PAGE_BYTES: u64 = (PAGE * size_of::<RockVertex>()) as u64;
const FIRST_CAPACITY: u32 = 256;

/// The rocks of one tile on the adapter.
#[derive(Debug)]
pub(super) struct PagedRocks {
    pub pages: Vec<u32>,
    /// Three a triangle, of vertices in the buffer.
    pub indices: Vec<u32>,
}

/// All pages, in one buffer.
#[derive(Debug)]
pub(super) struct RockPages {
    buffer: wgpu::Buffer,
    capacity: u32,
    free: Vec<u32>,
}

impl RockPages {
    pub(super) fn new(gpu: &Gpu) -> Self {
        RockPages {
            buffer: page_buffer(gpu, FIRST_CAPACITY),
            capacity: FIRST_CAPACITY,
            free: (0..FIRST_CAPACITY).rev().collect(),
        }
    }

    pub(super) fn buffer(&self) -> &wgpu::Buffer {
        &self.buffer
    }

    /// Pages that the buffer holds.
    pub(super) fn capacity(&self) -> usize {
        self.capacity as usize
    }

    /// Pages that no rocks are in.
    pub(super) fn free(&self) -> usize {
        self.free.len()
    }

    /// Pages that rocks fill.
    pub(super) fn needed(rocks: &TileRocks) -> usize {
        rocks.vertices.len().div_ceil(PAGE)
    }

    /// Makes the buffer large enough for so many more pages; it is a new one if it was not.
    pub(super) fn reserve(&mut self, gpu: &Gpu, pages: usize) -> Result<(), RenderError> {
        let lacking = pages.saturating_sub(self.free.len());
        if lacking == 0 {
            return Ok(());
        }
        let needed = self.capacity() + lacking;
        let most = (gpu.device.limits().max_storage_buffer_binding_size / PAGE_BYTES) as usize;
        let capacity = needed.next_power_of_two().min(most) as u32;
        if needed > most {
            return Err(gpu.error("hold the rocks of this view", "there are too many: raise render.vertex_spacing_px"));
        }
        let larger = page_buffer(gpu, capacity);
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_buffer_to_buffer(&self.buffer, 0, &larger, 0, PAGE_BYTES * u64::from(self.capacity));
        gpu.queue.submit([encoder.finish()]);
        self.free.extend((self.capacity..capacity).rev());
        (self.buffer, self.capacity) = (larger, capacity);
        Ok(())
    }

    /// Brings rocks onto the adapter; there has to be room for them.
    pub(super) fn place(&mut self, gpu: &Gpu, rocks: &TileRocks) -> PagedRocks {
        let mut pages = Vec::with_capacity(Self::needed(rocks));
        for vertices in rocks.vertices.chunks(PAGE) {
            let page = self.free.pop().expect("room was made for every page");
            gpu.queue.write_buffer(&self.buffer, PAGE_BYTES * u64::from(page), bytemuck::cast_slice(vertices));
            pages.push(page);
        }
        let placed = |index: &u32| pages[*index as usize / PAGE] * PAGE as u32 + *index % PAGE as u32;
        let indices = rocks.indices.iter().map(placed).collect();
        PagedRocks { pages, indices }
    }

    /// Gives pages back.
    pub(super) fn release(&mut self, rocks: &PagedRocks) {
        self.free.extend(&rocks.pages);
    }
}

fn page_buffer(gpu: &Gpu, capacity: u32) -> wgpu::Buffer {
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC;
    buffer(gpu, PAGE_BYTES * u64::from(capacity), usage)
}
