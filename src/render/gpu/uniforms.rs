//! What the shaders read, with exactly their layout.

use bytemuck::{Pod, Zeroable};
use nalgebra::{Matrix4, Vector3};

/// Octaves of detail that a table holds: `OCTAVES` in `shaders/noise.wgsl`.
pub const OCTAVES: usize = 32;

/// `Geometry` in `shaders/terrain_geometry.wgsl` and `shaders/body_geometry.wgsl`.
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub struct Geometry {
    pub clip_from_relative: [[f32; 4]; 4],
    pub forward: [f32; 4],
    pub camera_high: [f32; 4],
    pub camera_low: [f32; 4],
    pub level: [f32; 4],
}

/// `Tile` in `shaders/terrain_geometry.wgsl`.
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub struct Tile {
    pub base: [f32; 2],
    pub spacing: f32,
    pub slot: u32,
}

/// `Octave` in `shaders/noise.wgsl`.
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub struct Octave {
    pub row_x: [f32; 4],
    pub row_y: [f32; 4],
    pub row_z: [f32; 4],
    pub cell: [i32; 4],
    pub fraction: [f32; 4],
}

/// `Photometry` in `shaders/photometry.wgsl`.
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub struct Photometry {
    pub asymmetry: f32,
    pub opposition_amplitude: f32,
    pub opposition_width: f32,
    pub unused: f32,
    pub lunar: [f32; 4],
    pub rough: [f32; 4],
}

/// `Shading` in `shaders/shading.wgsl`.
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub struct Shading {
    pub reference_from_camera: [[f32; 4]; 4],
    pub shadow_from_relative: [[f32; 4]; 4],
    pub sun: [f32; 4],
    pub focal: [f32; 4],
    pub raster: [f32; 4],
    pub surface: [f32; 4],
    pub shadow: [f32; 4],
    pub level: [f32; 4],
    pub photometry: Photometry,
    pub octaves: [Octave; OCTAVES],
}

/// Vertex of a small body: position and normal in the asteroid frame.
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub struct BodyVertex {
    pub position: [f32; 3],
    pub normal: [f32; 3],
}

/// Vertex of a small body with albedo painted on it: also texture coordinates, or the albedo over its mean and 0.
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub struct PaintedVertex {
    pub position: [f32; 3],
    pub normal: [f32; 3],
    pub paint: [f32; 2],
}

/// `AlbedoMap` in `shaders/albedo_map.wgsl`.
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub struct AlbedoMap {
    pub origin: [f32; 4],
    pub counts: [u32; 4],
}

/// Columns of a matrix, rounded to f32.
pub fn columns(matrix: &Matrix4<f64>) -> [[f32; 4]; 4] {
    matrix.map(|v| v as f32).into()
}

/// A vector and a fourth number, rounded to f32.
pub fn four(v: &Vector3<f64>, w: f64) -> [f32; 4] {
    [v.x as f32, v.y as f32, v.z as f32, w as f32]
}

/// What rounding to f32 drops of a vector.
pub fn dropped(v: &Vector3<f64>) -> Vector3<f64> {
    v.map(|c| c - f64::from(c as f32))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::mem::{offset_of, size_of};
    use wgpu::naga;

    /// Offsets of a struct's members and its size, as naga reads the shader.
    fn wgsl_layout(source: &str, name: &str) -> (Vec<(String, u32)>, u32) {
        let module = naga::front::wgsl::parse_str(source).expect("a valid shader");
        let (_, found) = module.types.iter().find(|(_, t)| t.name.as_deref() == Some(name)).expect("the struct");
        let naga::TypeInner::Struct { members, span } = &found.inner else { panic!("{name} is not a struct") };
        (members.iter().map(|m| (m.name.clone().unwrap_or_default(), m.offset)).collect(), *span)
    }

    macro_rules! assert_layout {
        ($source:expr, $type:ty, [$($field:ident),*]) => {
            let rust = vec![$((stringify!($field).to_string(), offset_of!($type, $field) as u32)),*];
            let name = stringify!($type);
            assert_eq!(wgsl_layout($source, name), (rust, size_of::<$type>() as u32), "layout of {name}");
        };
    }

    #[test]
    fn structs_have_the_layout_of_the_shaders() {
        let terrain = include_str!("../../../shaders/terrain_geometry.wgsl");
        let body = include_str!("../../../shaders/body_geometry.wgsl");
        let shading = crate::render::shading::SOURCE;
        for source in [terrain, body] {
            assert_layout!(source, Geometry, [clip_from_relative, forward, camera_high, camera_low, level]);
        }
        assert_layout!(crate::render::body::SOURCE, AlbedoMap, [origin, counts]);
        assert_layout!(terrain, Tile, [base, spacing, slot]);
        assert_layout!(shading, Photometry, [asymmetry, opposition_amplitude, opposition_width, unused, lunar, rough]);
        assert_layout!(shading, Octave, [row_x, row_y, row_z, cell, fraction]);
        assert_layout!(
            shading,
            Shading,
            [
                reference_from_camera,
                shadow_from_relative,
                sun,
                focal,
                raster,
                surface,
                shadow,
                level,
                photometry,
                octaves
            ]
        );
        assert!(shading.contains(&format!("OCTAVES: u32 = {OCTAVES}u")));
    }
}
