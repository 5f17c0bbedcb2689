//! Pipelines that draw geometry: into surface samples for an image, or into the shadow map.

use super::device::Gpu;

/// Format of surface samples: three numbers of the surface, and z-depth in m.
pub(super) const SAMPLE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;
/// Format of depth buffers.
pub const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Which image is being drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    PageImage,
    Shadow,
}

/// The two pipelines of one kind of geometry.
#[derive(Debug)]
pub struct GeometryPipelines {
    image: wgpu::RenderPipeline,
    shadow: wgpu::RenderPipeline,
}

/// What differs between kinds of geometry.
pub struct GeometryKind<'a> {
    pub source: &'a str,
    /// Entry points of the image's vertex and fragment stage.
    pub entries: [&'a str; 2],
    /// Entry point of the shadow map's vertex stage.
    pub shadow_entry: &'a str,
    pub buffers: &'a [Option<wgpu::VertexBufferLayout<'a>>],
    pub bindings: &'a [wgpu::BindGroupLayoutEntry],
    /// Sides of triangles that images, and that shadow maps leave out.
    pub culled: [Option<wgpu::Face>; 2],
}

impl GeometryPipelines {
    pub fn new(gpu: &Gpu, kind: &GeometryKind) -> Self {
        let device = &gpu.device;
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("geometry"),
            source: wgpu::ShaderSource::Wgsl(kind.source.into()),
        });
        let group = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("geometry"),
            entries: kind.bindings,
        });
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("geometry"),
            bind_group_layouts: &[Some(&group)],
            immediate_size: 0,
        });
        let build = |role| pipeline(device, &module, &layout, kind, role);
        GeometryPipelines { image: build(Role::PageImage), shadow: build(Role::Shadow) }
    }

    pub fn of(&self, role: Role) -> &wgpu::RenderPipeline {
        match role {
            Role::PageImage => &self.image,
            Role::Shadow => &self.shadow,
        }
    }
}

fn pipeline(
    device: &wgpu::Device,
    module: &wgpu::ShaderModule,
    layout: &wgpu::PipelineLayout,
    kind: &GeometryKind,
    role: Role,
) -> wgpu::RenderPipeline {
    let targets = [Some(wgpu::ColorTargetState::from(SAMPLE_FORMAT))];
    let (entry, depth_compare) = match role {
        Role::PageImage => (kind.entries[0], wgpu::CompareFunction::Greater),
        Role::Shadow => (kind.shadow_entry, wgpu::CompareFunction::Less),
    };
    let cull_mode = kind.culled[role as usize];
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("geometry"),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(entry),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: kind.buffers,
        },
        primitive: wgpu::PrimitiveState { cull_mode, ..wgpu::PrimitiveState::default() },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(true),
            depth_compare: Some(depth_compare),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: (role == Role::PageImage).then(|| wgpu::FragmentState {
            module,
            entry_point: Some(kind.entries[1]),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// A uniform buffer at a binding of the vertex stage.
pub fn uniform_entry(binding: u32, visibility: wgpu::ShaderStages) -> wgpu::BindGroupLayoutEntry {
    buffer_entry(binding, visibility, wgpu::BufferBindingType::Uniform)
}

/// A read-only storage buffer at a binding of the vertex stage.
pub fn storage_entry(binding: u32) -> wgpu::BindGroupLayoutEntry {
    buffer_entry(binding, wgpu::ShaderStages::VERTEX, wgpu::BufferBindingType::Storage { read_only: true })
}

fn buffer_entry(
    binding: u32,
    visibility: wgpu::ShaderStages,
    ty: wgpu::BufferBindingType,
) -> wgpu::BindGroupLayoutEntry {
    let ty = wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None }
}

/// A buffer of the given use, empty.
pub fn buffer(gpu: &Gpu, size: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false })
}
