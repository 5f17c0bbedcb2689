//! Vertices of rocks on the adapter, in pages of one tile each.

use super::rocks::{RockVertex, TileRocks};
use crate::render::error::RenderError;
use crate::render::gpu::{Gpu, buffer};

/// Vertices of a page: `PAGE` in `shaders/terrain_geometry.wgsl`.
const PAGE: usize = 256;
const PAGE_BYTES: u64 = (PAGE * size_of::<RockVertex>()) as u64;
/// Pages of a buffer: 16 MiB, which every adapter binds.
pub(super) const BOOK: usize = 1024;
/// Pages up to which tiles that are not in use keep theirs.
const MOST_KEPT: usize = 4 * BOOK;

/// The rocks of one tile on the adapter.
#[derive(Debug, Default)]
pub(super) struct PagedRocks {
    /// Which buffer they are in.
    pub book: usize,
    pub pages: Vec<u32>,
    /// Three a triangle, of vertices in the buffer.
    pub indices: Vec<u32>,
}

/// All pages, in buffers of equal size.
#[derive(Debug, Default)]
pub(super) struct RockPages {
    books: Vec<RockBuffers>,
}

#[derive(Debug)]
struct RockBuffers {
    buffer: wgpu::Buffer,
    free: Vec<u32>,
}

impl RockPages {
    pub(super) fn buffers(&self) -> impl ExactSizeIterator<Item = &wgpu::Buffer> {
        self.books.iter().map(|book| &book.buffer)
    }

    /// Pages that rocks fill.
    pub(super) fn needed(rocks: &TileRocks) -> usize {
        rocks.vertices.len().div_ceil(PAGE)
    }

    /// Whether there is room for so many more pages without sending tiles away that are not in use.
    pub(super) fn has_room(&self, pages: usize) -> bool {
        let free: usize = self.books.iter().map(|book| book.free.len()).sum();
        free + MOST_KEPT.saturating_sub(BOOK * self.books.len()) >= pages
    }

    /// Brings the rocks of a tile onto the adapter.
    pub(super) fn place(&mut self, gpu: &Gpu, rocks: &TileRocks) -> Result<PagedRocks, RenderError> {
        let needed = Self::needed(rocks);
        if needed == 0 {
            return Ok(PagedRocks::default());
        }
        if needed > BOOK {
            return Err(
                gpu.error("hold the rocks of a tile", format!("{} vertices are too many", rocks.vertices.len()))
            );
        }
        let book = self.books.iter().position(|book| book.free.len() >= needed).unwrap_or_else(|| {
            let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
            let buffer = buffer(gpu, PAGE_BYTES * BOOK as u64, usage);
            self.books.push(RockBuffers { buffer, free: (0..BOOK as u32).rev().collect() });
            self.books.len() - 1
        });
        let RockBuffers { buffer, free } = &mut self.books[book];
        let pages = free.split_off(free.len() - needed);
        for (page, vertices) in pages.iter().zip(rocks.vertices.chunks(PAGE)) {
            gpu.queue.write_buffer(buffer, PAGE_BYTES * u64::from(*page), bytemuck::cast_slice(vertices));
        }
        let placed = |index: &u32| pages[*index as usize / PAGE] * PAGE as u32 + *index % PAGE as u32;
        let indices = rocks.indices.iter().map(placed).collect();
        Ok(PagedRocks { book, pages, indices })
    }

    /// Gives pages back.
    pub(super) fn release(&mut self, rocks: &PagedRocks) {
        if !rocks.pages.is_empty() {
            self.books[rocks.book].free.extend(&rocks.pages);
        }
    }
}
