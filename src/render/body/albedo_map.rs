//! Albedo painted on a small body, on the adapter (`shaders/albedo_map.wgsl`).

use crate::render::error::RenderError;
use crate::render::gpu::{AlbedoMap, Gpu};
use crate::scene::{AlbedoImage, ImageEdge, Mesh, MeshAlbedo};
use nalgebra::Vector3;
use std::collections::HashMap;
use wgpu::util::DeviceExt;

/// The module that draws a painted body.
pub const SOURCE: &str =
    concat!(include_str!("../../../shaders/body_geometry.wgsl"), include_str!("../../../shaders/albedo_map.wgsl"));

/// `TEXTURE` and `GLOBE` of the shader; 0 is the albedo of vertices.
const TEXTURE: u32 = 1;
const GLOBE: u32 = 2;

/// What the shader reads besides the vertices.
#[derive(Debug)]
pub(super) struct AlbedoBuffers {
    pub uniform: wgpu::Buffer,
    pub picture: wgpu::TextureView,
}

impl AlbedoBuffers {
    /// `None` for an albedo that is the same everywhere.
    pub fn new(gpu: &Gpu, albedo: &MeshAlbedo) -> Result<Option<Self>, RenderError> {
        let (kind, image, origin_m, west_edge_rad) = match albedo {
            MeshAlbedo::Uniform => return Ok(None),
            MeshAlbedo::Vertices(_) => (0, None, Vector3::zeros(), 0.0),
            MeshAlbedo::Texture { image, .. } => (TEXTURE, Some(image), Vector3::zeros(), 0.0),
            MeshAlbedo::Globe(map) => (GLOBE, Some(&map.image), map.origin_m, map.west_edge_rad),
        };
        let levels = image.map_or_else(|| vec![Level { size: [1, 1], values: vec![1.0] }], pyramid);
        let repeats = image.is_some_and(|image| image.vertical_edge() == ImageEdge::Repeat);
        let data = AlbedoMap {
            origin: crate::render::gpu::four(&origin_m, west_edge_rad),
            counts: [kind, u32::from(repeats), levels.len() as u32, 0],
        };
        let uniform = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("albedo map"),
            contents: bytemuck::bytes_of(&data),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        Ok(Some(AlbedoBuffers { uniform, picture: upload(gpu, &levels)? }))
    }
}

/// Three numbers a vertex: the mesh's vertex, and texture coordinates or its albedo.
pub(super) struct PaintedVertices {
    /// Vertex of the mesh and paint, for each vertex on the adapter.
    pub vertices: Vec<(u32, [f32; 2])>,
    /// Vertices on the adapter of each face.
    pub faces: Vec<[u32; 3]>,
}

impl PaintedVertices {
    /// Vertices of a mesh; where a texture has a seam, a vertex is there once for each side.
    pub fn new(mesh: &Mesh) -> Self {
        let numbered = 0..mesh.vertices_m.len() as u32;
        match &mesh.albedo {
            MeshAlbedo::Texture { corners, .. } => Self::with_seams(mesh, corners),
            MeshAlbedo::Vertices(values) => {
                let vertices = numbered.zip(values).map(|(vertex, value)| (vertex, [*value, 0.0])).collect();
                PaintedVertices { vertices, faces: mesh.faces.clone() }
            }
            _ => {
                let vertices = numbered.map(|vertex| (vertex, [1.0, 0.0])).collect();
                PaintedVertices { vertices, faces: mesh.faces.clone() }
            }
        }
    }

    fn with_seams(mesh: &Mesh, corners: &[[[f32; 2]; 3]]) -> Self {
        let mut vertices = Vec::with_capacity(mesh.vertices_m.len());
        let mut number_of: HashMap<(u32, [u32; 2]), u32> = HashMap::with_capacity(mesh.vertices_m.len());
        let mut number = |vertex: u32, paint: [f32; 2]| {
            *number_of.entry((vertex, paint.map(f32::to_bits))).or_insert_with(|| {
                vertices.push((vertex, paint));
                (vertices.len() - 1) as u32
            })
        };
        let face = |(face, paint): (&[u32; 3], &[[f32; 2]; 3])| [0, 1, 2].map(|k| number(face[k], paint[k]));
        let faces = mesh.faces.iter().zip(corners).map(face).collect();
        PaintedVertices { vertices, faces }
    }
}

/// One level of a pyramid of images.
struct Level {
    size: [u32; 2],
    values: Vec<f32>,
}

/// The image, and halves of it down to one pixel.
fn pyramid(image: &AlbedoImage) -> Vec<Level> {
    let mut levels = vec![Level { size: image.size_px(), values: image.values().to_vec() }];
    while levels[levels.len() - 1].size != [1, 1] {
        let next = halved(&levels[levels.len() - 1]);
        levels.push(next);
    }
    levels
}

/// Half the size, rounded down; every pixel is the mean of what it covers, so that nothing moves.
fn halved(level: &Level) -> Level {
    let [width, height] = level.size;
    let size = level.size.map(|side| (side / 2).max(1));
    let narrow: Vec<f32> = level.values.chunks_exact(width as usize).flat_map(|row| means(row, size[0])).collect();
    let mut values = vec![0.0; size[0] as usize * size[1] as usize];
    for column in 0..size[0] as usize {
        let along: Vec<f32> = (0..height as usize).map(|row| narrow[row * size[0] as usize + column]).collect();
        for (row, value) in means(&along, size[1]).into_iter().enumerate() {
            values[row * size[0] as usize + column] = value;
        }
    }
    Level { size, values }
}

/// Means over `count` equal pieces of a row of pixels.
fn means(row: &[f32], count: u32) -> Vec<f32> {
    let piece = row.len() as f64 / f64::from(count);
    let mean = |k: u32| {
        let (start, end) = (piece * f64::from(k), piece * f64::from(k + 1));
        let covered = |i: usize| (end.min(i as f64 + 1.0) - start.max(i as f64)).max(0.0);
        let pixels = start as usize..(end.ceil() as usize).min(row.len());
        (pixels.map(|i| f64::from(row[i]) * covered(i)).sum::<f64>() / piece) as f32
    };
    (0..count).map(mean).collect()
}

fn upload(gpu: &Gpu, levels: &[Level]) -> Result<wgpu::TextureView, RenderError> {
    let [width, height] = levels[0].size;
    let limit_px = gpu.device.limits().max_texture_dimension_2d;
    if width.max(height) > limit_px {
        let problem =
            format!("its albedo image has {width} × {height} px, and the adapter takes {limit_px}: shrink it");
        return Err(RenderError::UnusableMesh { problem });
    }
    let descriptor = wgpu::TextureDescriptor {
        label: Some("albedo picture"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: levels.len() as u32,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::R32Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    };
    let values: Vec<f32> = levels.iter().flat_map(|level| level.values.iter().copied()).collect();
    let order = wgpu::util::TextureDataOrder::LayerMajor;
    let texture = gpu.device.create_texture_with_data(&gpu.queue, &descriptor, order, bytemuck::cast_slice(&values));
    Ok(texture.create_view(&wgpu::TextureViewDescriptor::default()))
}
