//! Copies a texture from the adapter to memory.

use super::device::Gpu;
use crate::render::error::RenderError;

/// A buffer that receives one texture of `bytes_per_px`.
#[derive(Debug)]
pub struct ReadBack {
    buffer: wgpu::Buffer,
    width_px: u32,
    height_px: u32,
    bytes_per_px: u32,
}

impl ReadBack {
    pub fn new(gpu: &Gpu, width_px: u32, height_px: u32, bytes_per_px: u32) -> Self {
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("read back"),
            size: u64::from(padded(width_px * bytes_per_px)) * u64::from(height_px),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        ReadBack { buffer, width_px, height_px, bytes_per_px }
    }

    pub fn copy_from(&self, encoder: &mut wgpu::CommandEncoder, texture: &wgpu::Texture) {
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(padded(self.width_px * self.bytes_per_px)),
            rows_per_image: None,
        };
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo { buffer: &self.buffer, layout },
            texture.size(),
        );
    }

    /// Asks for the content; ready once the device has been polled.
    pub fn request(&self) {
        self.buffer.map_async(wgpu::MapMode::Read, .., |_| ());
    }

    /// The rows without their padding.
    pub fn take(&self, gpu: &Gpu) -> Result<Vec<u8>, RenderError> {
        let row = (self.width_px * self.bytes_per_px) as usize;
        let mut bytes = Vec::with_capacity(row * self.height_px as usize);
        {
            let mapped = self.buffer.get_mapped_range(..).map_err(|e| gpu.error("read the picture back", e))?;
            for line in mapped.chunks(padded(row as u32) as usize) {
                bytes.extend_from_slice(&line[..row]);
            }
        }
        self.buffer.unmap();
        Ok(bytes)
    }
}

/// Rows of a copy begin at multiples of 256 bytes.
fn padded(bytes: u32) -> u32 {
    bytes.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT)
}

/// Finishes the commands and copies a whole buffer to memory.
#[cfg(test)]
pub(super) fn fetch_buffer(gpu: &Gpu, mut encoder: wgpu::CommandEncoder, source: &wgpu::Buffer) -> Vec<u8> {
    let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ;
    let target = super::geometry_pass::buffer(gpu, source.size(), usage);
    encoder.copy_buffer_to_buffer(source, 0, &target, 0, source.size());
    gpu.queue.submit([encoder.finish()]);
    target.map_async(wgpu::MapMode::Read, .., |_| ());
    gpu.device.poll(wgpu::PollType::wait_indefinitely()).expect("the adapter works");
    target.get_mapped_range(..).expect("a mapped buffer").to_vec()
}
