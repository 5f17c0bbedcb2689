//! One shading job: what is shaded, and how.

use crate::render::gpu::Shading;
use wgpu::TextureFormat::{R8Uint, R32Float, Rgba32Float};

/// Formats of radiance, depth and mask, and on request of normal and albedo, with their bytes a pixel.
const FORMATS: [(wgpu::TextureFormat, u32); 4] = [(R32Float, 4), (R32Float, 4), (R8Uint, 1), (Rgba32Float, 16)];

/// Which of the shader's variants is used.
#[derive(Debug, Clone, Copy)]
pub struct ShadingKind {
    /// Whether the surface is terrain, or a body.
    pub is_terrain: bool,
    /// The law of its photometry.
    pub photometry_model: u32,
    /// Whether normal and albedo are output too.
    pub surface_truth: bool,
}

impl ShadingKind {
    pub(super) fn formats(&self) -> &'static [(wgpu::TextureFormat, u32)] {
        &FORMATS[..if self.surface_truth { 4 } else { 3 }]
    }
}

/// What to shade.
#[derive(Debug)]
pub struct ShadingJob {
    pub numbers: Shading,
    /// Octaves in the table.
    pub octave_count: usize,
    /// Largest radius of the solar disc's image in the shadow map.
    pub widest_penumbra_texels: f64,
    /// [left, top, width, height] in px; nothing is hit outside.
    pub rectangle_px: [u32; 4],
}
