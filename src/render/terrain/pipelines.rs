//! Pipelines and buffers of the ground, or of the rocks on it.

use crate::render::gpu::{GeometryKind, GeometryPipelines, Gpu, Role, Tile, buffer, storage_entry, uniform_entry};

/// The image shows both sides: slivers of vertices that have nearly slid onto each other face either way by rounding, and
/// none may be missing. The shadow map leaves out the ground that faces the Sun (its right and up and the direction of light
/// are right-handed, so that it shows triangles mirrored): light that something keeps from ground has entered what keeps it
/// away by a side that faces away from the Sun, and without the other side lit ground cannot shadow itself (after Wang and
/// Molnar, "Second-depth shadow mapping", 1994).
const CULLED: [Option<wgpu::Face>; 2] = [None, Some(wgpu::Face::Back)];

/// The ground, or the rocks on it, as they are drawn.
#[derive(Debug)]
pub(super) struct Drawn {
    pipelines: GeometryPipelines,
    parts: Vec<Part>,
}

/// What comes from one buffer of vertices.
#[derive(Debug)]
struct Part {
    /// Where each tile, or each page of rocks, lies.
    places: wgpu::Buffer,
    groups: [wgpu::BindGroup; 2],
}

impl Drawn {
    /// Entry points of the vertex stages of image and shadow map.
    pub(super) fn new(gpu: &Gpu, [vertex, shadow_entry]: [&str; 2]) -> Self {
        let kind = GeometryKind {
            source: include_str!("../../../shaders/terrain_geometry.wgsl"),
            entries: [vertex, "fragment"],
            shadow_entry,
            buffers: &[],
            bindings: &[uniform_entry(0, wgpu::ShaderStages::VERTEX), storage_entry(1), storage_entry(2)],
            culled: CULLED,
        };
        Drawn { pipelines: GeometryPipelines::new(gpu, &kind), parts: Vec::new() }
    }

    /// Reads vertices from these buffers, each of up to `count` tiles or pages.
    pub(super) fn bind<'a>(
        &mut self,
        gpu: &Gpu,
        uniforms: &[wgpu::Buffer; 2],
        vertices: impl Iterator<Item = &'a wgpu::Buffer>,
        count: usize,
    ) {
        let part = |vertices: &wgpu::Buffer| {
            let places = place_buffer(gpu, count);
            let groups = bind(gpu, &self.pipelines, uniforms, [&places, vertices]);
            Part { places, groups }
        };
        self.parts = vertices.map(part).collect();
    }

    /// Buffers that vertices come from.
    pub(super) fn parts(&self) -> usize {
        self.parts.len()
    }

    /// Says where the tiles or pages of a part lie.
    pub(super) fn place(&self, gpu: &Gpu, part: usize, places: &[Tile]) {
        gpu.queue.write_buffer(&self.parts[part].places, 0, bytemuck::cast_slice(places));
    }

    pub(super) fn set(&self, pass: &mut wgpu::RenderPass, role: Role, part: usize) {
        pass.set_pipeline(self.pipelines.of(role));
        pass.set_bind_group(0, &self.parts[part].groups[role as usize], &[]);
    }
}

fn place_buffer(gpu: &Gpu, count: usize) -> wgpu::Buffer {
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
    buffer(gpu, (size_of::<Tile>() * count) as u64, usage)
}

fn bind(
    gpu: &Gpu,
    pipelines: &GeometryPipelines,
    uniforms: &[wgpu::Buffer; 2],
    storage: [&wgpu::Buffer; 2],
) -> [wgpu::BindGroup; 2] {
    [Role::PageImage, Role::Shadow].map(|role| {
        let buffers = [&uniforms[role as usize], storage[0], storage[1]];
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
