//! Draws a small body's mesh (`shaders/body_geometry.wgsl`).

use super::enclosure::encloses;
use super::geometry_pass::{GeometryKind, GeometryPipelines, Role, buffer, uniform_entry};
use super::gpu_data::{BodyVertex, Geometry};
use super::{Gpu, RenderError};
use crate::scene::{Mesh, View};
use nalgebra::Vector3;
use wgpu::util::DeviceExt;

#[derive(Debug)]
pub(super) struct BodyGeometry {
    mesh: Mesh,
    center_m: Vector3<f64>,
    radius_m: f64,
    pipelines: GeometryPipelines,
    uniforms: [(wgpu::Buffer, wgpu::BindGroup); 2],
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
}

impl BodyGeometry {
    pub(super) fn new(gpu: &Gpu, mesh: &Mesh) -> Result<Self, RenderError> {
        check(mesh)?;
        let (center_m, radius_m) = bounding_sphere(mesh);
        let attributes = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3];
        let layout = wgpu::VertexBufferLayout {
            array_stride: size_of::<BodyVertex>() as u64,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes: &attributes,
        };
        let kind = GeometryKind {
            source: include_str!("../../shaders/body_geometry.wgsl"),
            buffers: &[Some(layout)],
            bindings: &[uniform_entry(0, wgpu::ShaderStages::VERTEX)],
        };
        let pipelines = GeometryPipelines::new(gpu, &kind);
        let uniforms = [Role::Picture, Role::Shadow].map(|role| uniform(gpu, &pipelines, role));
        let upload = |contents: &[u8], usage| {
            gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some("mesh"), contents, usage })
        };
        Ok(BodyGeometry {
            center_m,
            radius_m,
            pipelines,
            uniforms,
            vertices: upload(bytemuck::cast_slice(&gpu_vertices(mesh)), wgpu::BufferUsages::VERTEX),
            indices: upload(bytemuck::cast_slice(&mesh.faces), wgpu::BufferUsages::INDEX),
            mesh: mesh.clone(),
        })
    }

    /// Centre (asteroid frame) and radius in m of a sphere around the body.
    pub(super) fn bounding_sphere(&self) -> (Vector3<f64>, f64) {
        (self.center_m, self.radius_m)
    }

    pub(super) fn check_view(&self, view: &View) -> Result<(), RenderError> {
        let camera = view.reference_from_camera.translation.vector;
        let near = (camera - self.center_m).norm() <= self.radius_m;
        if near && encloses(&self.mesh, &camera) {
            return Err(RenderError::CameraInsideBody { t_ns: view.t_ns });
        }
        Ok(())
    }

    pub(super) fn set_geometry(&self, gpu: &Gpu, role: Role, geometry: &Geometry) {
        gpu.queue.write_buffer(&self.uniforms[role as usize].0, 0, bytemuck::bytes_of(geometry));
    }

    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass, role: Role) {
        pass.set_pipeline(self.pipelines.of(role));
        pass.set_bind_group(0, &self.uniforms[role as usize].1, &[]);
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..3 * self.mesh.faces.len() as u32, 0, 0..1);
    }
}

fn uniform(gpu: &Gpu, pipelines: &GeometryPipelines, role: Role) -> (wgpu::Buffer, wgpu::BindGroup) {
    let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
    let uniform = buffer(gpu, size_of::<Geometry>() as u64, usage);
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("body geometry"),
        layout: &pipelines.of(role).get_bind_group_layout(0),
        entries: &[wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() }],
    });
    (uniform, group)
}

fn check(mesh: &Mesh) -> Result<(), RenderError> {
    let unusable = |problem: String| Err(RenderError::UnusableMesh { problem });
    if mesh.faces.is_empty() {
        return unusable("it has no faces".into());
    }
    if let Some(v) = mesh.vertices_m.iter().position(|v| !v.iter().all(|c| c.is_finite())) {
        return unusable(format!("vertex {v} is not a finite point"));
    }
    let count = mesh.vertices_m.len();
    if let Some(f) = mesh.faces.iter().position(|face| face.iter().any(|i| *i as usize >= count)) {
        return unusable(format!("face {f} names a vertex beyond the last of {count}"));
    }
    Ok(())
}

fn bounding_sphere(mesh: &Mesh) -> (Vector3<f64>, f64) {
    let low = mesh.vertices_m.iter().fold(Vector3::repeat(f64::INFINITY), |low, v| low.inf(v));
    let high = mesh.vertices_m.iter().fold(Vector3::repeat(f64::NEG_INFINITY), |high, v| high.sup(v));
    let center = 0.5 * (low + high);
    let radius = mesh.vertices_m.iter().map(|v| (v - center).norm()).fold(0.0, f64::max);
    (center, radius.max(1e-6))
}

/// Vertices with angle-weighted normals, which do not depend on how the surface is cut into triangles.
///
/// Source: Thürmer and Wüthrich, "Computing vertex normals from polygonal facets", Journal of Graphics Tools 3(1), 1998.
fn gpu_vertices(mesh: &Mesh) -> Vec<BodyVertex> {
    let mut normals = vec![Vector3::zeros(); mesh.vertices_m.len()];
    for face in &mesh.faces {
        let [a, b, c] = face.map(|i| mesh.vertices_m[i as usize]);
        let Some(normal) = (b - a).cross(&(c - a)).try_normalize(0.0) else { continue };
        let angles = [(b - a).angle(&(c - a)), (c - b).angle(&(a - b)), (a - c).angle(&(b - c))];
        for (i, angle) in face.iter().zip(angles) {
            normals[*i as usize] += normal * angle;
        }
    }
    let vertex = |(p, n): (&Vector3<f64>, &Vector3<f64>)| {
        let normal = n.try_normalize(0.0).unwrap_or_else(Vector3::z);
        BodyVertex { position: p.map(|c| c as f32).into(), normal: normal.map(|c| c as f32).into() }
    };
    mesh.vertices_m.iter().zip(&normals).map(vertex).collect()
}
