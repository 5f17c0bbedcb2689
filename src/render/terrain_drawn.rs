//! Pipelines and buffers of the ground, or of the rocks on it.

use super::Gpu;
use super::geometry_pass::{GeometryKind, GeometryPipelines, Role, buffer, storage_entry, uniform_entry};
use super::gpu_data::Tile;

/// The picture shows both sides: slivers of vertices that have nearly slid onto each other face either way by rounding, and
/// none may be missing. The shadow map leaves out the ground that faces the Sun (its right and up and the direction of light
/// are right-handed, so that it shows triangles mirrored): light that something keeps from ground has entered what keeps it
/// away by a side that faces away from the Sun, and without the other side lit ground cannot shadow itself (after Wang and
/// Molnar, "Second-depth shadow mapping", 1994).
const CULLED: [Option<wgpu::Face>; 2] = [None, Some(wgpu::Face::Back)];

/// The ground, or the rocks on it, as they are drawn.
#[derive(Debug)]
pub(super) struct Drawn {
    pipelines: GeometryPipelines,
    /// Where each tile, or each page of rocks, lies.
    pub places: wgpu::Buffer,
    groups: [wgpu::BindGroup; 2],
}

impl Drawn {
    /// Entry points of the vertex stages of picture and shadow map; vertices, and how many tiles or pages they come in.
    pub(super) fn new(
        gpu: &Gpu,
        [vertex, shadow_entry]: [&str; 2],
        uniforms: &[wgpu::Buffer; 2],
        vertices: (&wgpu::Buffer, usize),
    ) -> Self {
        let kind = GeometryKind {
            source: include_str!("../../shaders/terrain_geometry.wgsl"),
            entries: [vertex, "fragment"],
            shadow_entry,
            buffers: &[],
            bindings: &[uniform_entry(0, wgpu::ShaderStages::VERTEX), storage_entry(1), storage_entry(2)],
            culled: CULLED,
        };
        let pipelines = GeometryPipelines::new(gpu, &kind);
        let places = place_buffer(gpu, vertices.1);
        let groups = bind(gpu, &pipelines, uniforms, [&places, vertices.0]);
        Drawn { pipelines, places, groups }
    }

    /// Reads vertices from other buffers than before.
    pub(super) fn bind(&mut self, gpu: &Gpu, uniforms: &[wgpu::Buffer; 2], vertices: (&wgpu::Buffer, usize)) {
        self.places = place_buffer(gpu, vertices.1);
        self.groups = bind(gpu, &self.pipelines, uniforms, [&self.places, vertices.0]);
    }

    pub(super) fn set(&self, pass: &mut wgpu::RenderPass, role: Role) {
        pass.set_pipeline(self.pipelines.of(role));
        pass.set_bind_group(0, &self.groups[role as usize], &[]);
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
    [Role::Picture, Role::Shadow].map(|role| {
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
