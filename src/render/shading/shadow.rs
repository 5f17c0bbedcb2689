//! The shadow map: an orthographic image of the surface from the Sun, fitted to what the camera sees.

use crate::render::gpu::{DEPTH_FORMAT, Gpu};
use nalgebra::{Matrix3, Matrix4, Rotation3, Unit, Vector3};

/// The map's texture.
#[derive(Debug)]
pub struct ShadowMap {
    pub view: wgpu::TextureView,
    pub sampler: wgpu::Sampler,
    side_px: u32,
}

/// The box that the map covers.
#[derive(Debug, Clone, Copy)]
pub struct ShadowBox {
    /// Axes of the map in the reference frame, as rows: right, up, and away from the Sun.
    pub axes: Matrix3<f64>,
    /// Centre relative to the camera, reference axes, m.
    pub center_m: Vector3<f64>,
    /// Half of its sides along the axes, m.
    pub half_m: Vector3<f64>,
}

impl ShadowMap {
    pub fn new(gpu: &Gpu, side_px: u32) -> Self {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("shadow map"),
            size: wgpu::Extent3d { width: side_px, height: side_px, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: DEPTH_FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("shadow map"),
            ..wgpu::SamplerDescriptor::default()
        });
        ShadowMap { view: texture.create_view(&wgpu::TextureViewDescriptor::default()), sampler, side_px }
    }

    /// Width and height of a texel, and depth of the map, in m.
    pub fn texel_m(&self, covered: &ShadowBox) -> Vector3<f64> {
        let size = f64::from(self.side_px);
        covered.half_m.component_div(&Vector3::new(0.5 * size, 0.5 * size, 0.5))
    }

    pub fn begin<'a>(&self, encoder: &'a mut wgpu::CommandEncoder) -> wgpu::RenderPass<'a> {
        let ops = wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Store };
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shadow map"),
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.view,
                depth_ops: Some(ops),
                stencil_ops: None,
            }),
            ..wgpu::RenderPassDescriptor::default()
        })
    }
}

/// Axes of the map in the reference frame, as rows; the third points away from the Sun.
pub fn shadow_axes(sun_in_reference: &Unit<Vector3<f64>>) -> Matrix3<f64> {
    let away = -sun_in_reference.into_inner();
    let helper = if away.z.abs() < 0.9 { Vector3::z() } else { Vector3::x() };
    let right = helper.cross(&away).normalize();
    let up = away.cross(&right);
    Matrix3::from_rows(&[right.transpose(), up.transpose(), away.transpose()])
}

impl ShadowBox {
    /// The smallest box, over how it is turned about the light, around places relative to the camera (reference axes, m).
    pub fn around(sun_in_reference: &Unit<Vector3<f64>>, places_m: &[Vector3<f64>]) -> ShadowBox {
        const TURNS: u32 = 16;
        let first = shadow_axes(sun_in_reference);
        let turned = |k: u32| {
            let angle_rad = f64::from(k) / f64::from(TURNS) * std::f64::consts::FRAC_PI_2;
            let axes = Rotation3::from_axis_angle(&Vector3::z_axis(), angle_rad).matrix() * first;
            let (mut low, mut high) = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
            for place_m in places_m {
                let seen = axes * place_m;
                (low, high) = (low.inf(&seen), high.sup(&seen));
            }
            ShadowBox { axes, center_m: axes.tr_mul(&(0.5 * (low + high))), half_m: 0.5 * (high - low) }
        };
        let area = |covered: &ShadowBox| covered.half_m.x * covered.half_m.y;
        let smaller = |best: ShadowBox, other: ShadowBox| if area(&other) < area(&best) { other } else { best };
        (1..TURNS).map(turned).fold(turned(0), smaller)
    }

    /// From places relative to the camera (reference axes) to the map's clip space; depth runs from 0 at the Sun to 1.
    pub fn clip_from_relative(&self) -> Matrix4<f64> {
        let scale = Vector3::new(1.0 / self.half_m.x, 1.0 / self.half_m.y, 0.5 / self.half_m.z);
        let linear = Matrix3::from_diagonal(&scale) * self.axes;
        let offset = Vector3::new(0.0, 0.0, 0.5) - linear * self.center_m;
        let mut clip = linear.to_homogeneous();
        clip.fixed_view_mut::<3, 1>(0, 3).copy_from(&offset);
        clip
    }
}

/// From clip space to texture coordinates, y downwards, and depth.
pub fn texture_from_clip() -> Matrix4<f64> {
    #[rustfmt::skip]
    let matrix = Matrix4::new(
        0.5, 0.0, 0.0, 0.5,
        0.0, -0.5, 0.0, 0.5,
        0.0, 0.0, 1.0, 0.0,
        0.0, 0.0, 0.0, 1.0,
    );
    matrix
}
