//! Textures that an image passes through.

use super::device::Gpu;
use super::geometry_pass::{DEPTH_FORMAT, SAMPLE_FORMAT};

/// Surface samples with their depth buffer.
#[derive(Debug)]
pub struct SampleTarget {
    pub samples: wgpu::TextureView,
    depth: wgpu::TextureView,
}

impl SampleTarget {
    pub fn new(gpu: &Gpu, size: (u32, u32)) -> Self {
        let make =
            |format, usage| texture(gpu, size, format, usage).create_view(&wgpu::TextureViewDescriptor::default());
        SampleTarget {
            samples: make(SAMPLE_FORMAT, wgpu::TextureUsages::TEXTURE_BINDING),
            depth: make(DEPTH_FORMAT, wgpu::TextureUsages::empty()),
        }
    }

    /// Begins to draw, with every sample saying "nothing" and the depth at infinity (0, for it is reversed).
    pub fn begin<'a>(&self, encoder: &'a mut wgpu::CommandEncoder) -> wgpu::RenderPass<'a> {
        let ops = wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard };
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("surface samples"),
            color_attachments: &[Some(cleared(&self.samples))],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth,
                depth_ops: Some(ops),
                stencil_ops: None,
            }),
            ..wgpu::RenderPassDescriptor::default()
        })
    }
}

/// A colour attachment cleared to zeros.
pub fn cleared(view: &wgpu::TextureView) -> wgpu::RenderPassColorAttachment<'_> {
    wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), store: wgpu::StoreOp::Store },
    }
}

/// A texture that can be drawn to.
pub fn texture(
    gpu: &Gpu,
    (width, height): (u32, u32),
    format: wgpu::TextureFormat,
    usage: wgpu::TextureUsages,
) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: usage | wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    })
}
