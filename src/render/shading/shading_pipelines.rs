//! Variants of the shader that shades (`shaders/shading.wgsl`), each made when an image first needs it.

use super::job::{ShadingJob, ShadingKind};
use crate::render::gpu::Gpu;
use crate::render::optics::Lens;
use std::cell::OnceCell;

/// The shader with all that it calls.
pub const SOURCE: &str = concat!(
    include_str!("../../../shaders/noise.wgsl"),
    include_str!("../../../shaders/photometry.wgsl"),
    include_str!("../../../shaders/lens.wgsl"),
    include_str!("../../../shaders/shadow.wgsl"),
    include_str!("../../../shaders/shading.wgsl")
);

/// Half shadow up to this radius is left to the shadow map's own blur.
const NARROW_TEXELS: f64 = 1.0;
/// Terrain with up to this many octaves evaluates them one by one, without a loop: a software adapter fetches what an index
/// chooses for each pixel, and what a constant chooses once. `octaves_one_by_one` in the shader.
const MOST_ONE_BY_ONE: usize = 6;

/// The variants for one camera and one kind of surface.
#[derive(Debug)]
pub(super) struct ShadingPipelines {
    module: wgpu::ShaderModule,
    layout: wgpu::PipelineLayout,
    entry: &'static str,
    formats: Vec<wgpu::TextureFormat>,
    constants: Vec<(&'static str, f64)>,
    is_terrain: bool,
    /// By whether half shadow may be wider than the map's own blur, then by the number of octaves evaluated one by one.
    made: [[OnceCell<wgpu::RenderPipeline>; MOST_ONE_BY_ONE + 1]; 2],
}

impl ShadingPipelines {
    pub(super) fn new(gpu: &Gpu, group: &wgpu::BindGroupLayout, kind: &ShadingKind, lens: &Lens) -> Self {
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("shading"),
            source: wgpu::ShaderSource::Wgsl(SOURCE.into()),
        });
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("shading"),
            bind_group_layouts: &[Some(group)],
            immediate_size: 0,
        });
        let constants = vec![
            ("LENS", f64::from(u8::from(lens.is_distorting()))),
            ("STRIDE", f64::from(lens.grid.stride)),
            ("TAPS", f64::from(lens.grid.taps())),
            ("NARROW", NARROW_TEXELS),
            ("TERRAIN", f64::from(u8::from(kind.is_terrain))),
            ("MODEL", f64::from(kind.photometry_model)),
        ];
        ShadingPipelines {
            module,
            layout,
            entry: if kind.surface_truth { "picture_with_surface" } else { "picture" },
            formats: kind.formats().iter().map(|(format, _)| *format).collect(),
            constants,
            is_terrain: kind.is_terrain,
            made: Default::default(),
        }
    }

    /// The variant for an image.
    pub(super) fn of(&self, gpu: &Gpu, job: &ShadingJob) -> &wgpu::RenderPipeline {
        let is_wide = job.widest_penumbra_texels > NARROW_TEXELS;
        let one_by_one = if self.is_terrain && job.octave_count <= MOST_ONE_BY_ONE { job.octave_count } else { 0 };
        self.made[usize::from(is_wide)][one_by_one].get_or_init(|| self.make(gpu, is_wide, one_by_one))
    }

    fn make(&self, gpu: &Gpu, is_wide: bool, one_by_one: usize) -> wgpu::RenderPipeline {
        let mut constants = self.constants.clone();
        constants.extend([("WIDE_PENUMBRA", f64::from(u8::from(is_wide))), ("ONE_BY_ONE", one_by_one as f64)]);
        let targets: Vec<_> = self.formats.iter().map(|f| Some(wgpu::ColorTargetState::from(*f))).collect();
        let compilation_options = wgpu::PipelineCompilationOptions::default;
        gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("shading"),
            layout: Some(&self.layout),
            vertex: wgpu::VertexState {
                module: &self.module,
                entry_point: Some("vertex"),
                compilation_options: compilation_options(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &self.module,
                entry_point: Some(self.entry),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants: &constants,
                    ..compilation_options()
                },
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}
