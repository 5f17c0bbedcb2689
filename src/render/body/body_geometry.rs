//! Draws a small body's mesh (`shaders/body_geometry.wgsl`).

use super::albedo_map::{self, AlbedoBuffers, PaintedVertices};
use super::enclosure::encloses;
use crate::render::error::RenderError;
use crate::render::gpu::{
    BodyVertex, Geometry, GeometryKind, GeometryPipelines, Gpu, PaintedVertex, Role, buffer, uniform_entry,
};
use crate::scene::{Mesh, MeshAlbedo, View};
use nalgebra::Vector3;
use wgpu::util::DeviceExt;

#[derive(Debug)]
pub struct BodyGeometry {
    mesh: Mesh,
    center_m: Vector3<f64>,
    radius_m: f64,
    bounding_box_m: [Vector3<f64>; 2],
    pipelines: GeometryPipelines,
    uniforms: [(wgpu::Buffer, wgpu::BindGroup); 2],
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
}

impl BodyGeometry {
    pub fn new(gpu: &Gpu, mesh: &Mesh) -> Result<Self, RenderError> {
        check(mesh)?;
        let (center_m, radius_m) = mesh.bounding_sphere();
        let albedo = AlbedoBuffers::new(gpu, &mesh.albedo)?;
        let pipelines = pipelines(gpu, albedo.is_some());
        let uniforms = [Role::PageImage, Role::Shadow].map(|role| uniform(gpu, &pipelines, (role, albedo.as_ref())));
        let upload = |contents: &[u8], usage| {
            gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some("mesh"), contents, usage })
        };
        let normals = vertex_normals(mesh);
        let (vertices, faces) = match albedo {
            None => (bytemuck::pod_collect_to_vec(&plain_vertices(mesh, &normals)), None),
            Some(_) => {
                let painted = PaintedVertices::new(mesh);
                (bytemuck::pod_collect_to_vec(&painted_vertices(mesh, &normals, &painted)), Some(painted.faces))
            }
        };
        let faces = faces.as_ref().unwrap_or(&mesh.faces);
        Ok(BodyGeometry {
            center_m,
            bounding_box_m: mesh.bounding_box(),
            radius_m: radius_m.max(1e-6),
            pipelines,
            uniforms,
            vertices: upload(&vertices, wgpu::BufferUsages::VERTEX),
            indices: upload(bytemuck::cast_slice(faces), wgpu::BufferUsages::INDEX),
            mesh: mesh.clone(),
        })
    }

    /// Centre (asteroid frame) and radius in m of a sphere around the body.
    pub fn bounding_sphere(&self) -> (Vector3<f64>, f64) {
        (self.center_m, self.radius_m)
    }

    /// Corners (asteroid frame) in m of a box around the body.
    pub fn box_corners_m(&self) -> [Vector3<f64>; 8] {
        let sides = self.bounding_box_m;
        std::array::from_fn(|k| Vector3::from_fn(|axis, _| sides[k >> axis & 1][axis]))
    }

    pub fn check_view(&self, view: &View) -> Result<(), RenderError> {
        let camera = view.reference_from_camera.translation.vector;
        let near = (camera - self.center_m).norm() <= self.radius_m;
        if near && encloses(&self.mesh, &camera) {
            return Err(RenderError::CameraInsideBody { t_ns: view.t_ns });
        }
        Ok(())
    }

    pub fn set_geometry(&self, gpu: &Gpu, role: Role, geometry: &Geometry) {
        gpu.queue.write_buffer(&self.uniforms[role as usize].0, 0, bytemuck::bytes_of(geometry));
    }

    pub fn draw(&self, pass: &mut wgpu::RenderPass, role: Role) {
        pass.set_pipeline(self.pipelines.of(role));
        pass.set_bind_group(0, &self.uniforms[role as usize].1, &[]);
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..3 * self.mesh.faces.len() as u32, 0, 0..1);
    }
}

/// Pipelines for a plain or a painted body.
fn pipelines(gpu: &Gpu, is_painted: bool) -> GeometryPipelines {
    let attributes = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x2];
    let (size, count) = if is_painted { (size_of::<PaintedVertex>(), 3) } else { (size_of::<BodyVertex>(), 2) };
    let layout = wgpu::VertexBufferLayout {
        array_stride: size as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &attributes[..count],
    };
    let buffers = [Some(layout)];
    let (vertex, fragment) = (wgpu::ShaderStages::VERTEX, wgpu::ShaderStages::FRAGMENT);
    let bindings = [uniform_entry(0, vertex), uniform_entry(1, vertex | fragment), image_entry(2)];
    let culled = [Some(wgpu::Face::Back), None];
    let (source, entries, bindings) = if is_painted {
        (albedo_map::SOURCE, ["painted_vertex", "painted_fragment"], &bindings[..])
    } else {
        (include_str!("../../../shaders/body_geometry.wgsl"), ["vertex", "fragment"], &bindings[..1])
    };
    let kind = GeometryKind { source, entries, shadow_entry: "shadow_vertex", buffers: &buffers, bindings, culled };
    GeometryPipelines::new(gpu, &kind)
}

fn image_entry(binding: u32) -> wgpu::BindGroupLayoutEntry {
    let ty = wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: false },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    wgpu::BindGroupLayoutEntry { binding, visibility: wgpu::ShaderStages::FRAGMENT, ty, count: None }
}

fn uniform(
    gpu: &Gpu,
    pipelines: &GeometryPipelines,
    (role, albedo): (Role, Option<&AlbedoBuffers>),
) -> (wgpu::Buffer, wgpu::BindGroup) {
    let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
    let uniform = buffer(gpu, size_of::<Geometry>() as u64, usage);
    let mut resources = vec![uniform.as_entire_binding()];
    if let Some(albedo) = albedo {
        resources.extend([albedo.uniform.as_entire_binding(), wgpu::BindingResource::TextureView(&albedo.picture)]);
    }
    let entries: Vec<_> =
        (0..).zip(resources).map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource }).collect();
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("body geometry"),
        layout: &pipelines.of(role).get_bind_group_layout(0),
        entries: &entries,
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
    let fits = match &mesh.albedo {
        MeshAlbedo::Vertices(values) => values.len() == count,
        MeshAlbedo::Texture { corners, .. } => corners.len() == mesh.faces.len(),
        MeshAlbedo::Uniform | MeshAlbedo::Globe(_) => true,
    };
    if !fits {
        return unusable("its albedo is not given for every vertex or face".into());
    }
    Ok(())
}

/// Angle-weighted normals of the vertices, which do not depend on how the surface is cut into triangles.
///
/// Source: Thürmer and Wüthrich, "Computing vertex normals from polygonal facets", Journal of Graphics Tools 3(1), 1998.
fn vertex_normals(mesh: &Mesh) -> Vec<[f32; 3]> {
    let mut normals = vec![Vector3::zeros(); mesh.vertices_m.len()];
    for face in &mesh.faces {
        let [a, b, c] = mesh.corners_m(face);
        let Some(normal) = (b - a).cross(&(c - a)).try_normalize(0.0) else { continue };
        let angles = [(b - a).angle(&(c - a)), (c - b).angle(&(a - b)), (a - c).angle(&(b - c))];
        for (i, angle) in face.iter().zip(angles) {
            normals[*i as usize] += normal * angle;
        }
    }
    normals.iter().map(|n| single(&n.try_normalize(0.0).unwrap_or_else(Vector3::z))).collect()
}

fn single(v: &Vector3<f64>) -> [f32; 3] {
    v.map(|c| c as f32).into()
}

fn plain_vertices(mesh: &Mesh, normals: &[[f32; 3]]) -> Vec<BodyVertex> {
    let vertex = |(p, normal): (&Vector3<f64>, &[f32; 3])| BodyVertex { position: single(p), normal: *normal };
    mesh.vertices_m.iter().zip(normals).map(vertex).collect()
}

fn painted_vertices(mesh: &Mesh, normals: &[[f32; 3]], painted: &PaintedVertices) -> Vec<PaintedVertex> {
    let vertex = |&(index, paint): &(u32, [f32; 2])| {
        let index = index as usize;
        PaintedVertex { position: single(&mesh.vertices_m[index]), normal: normals[index], paint }
    };
    painted.vertices.iter().map(vertex).collect()
}
