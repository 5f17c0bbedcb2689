//! From a camera, lens included, to the pinhole image that is drawn.
//!
//! The adapter draws straight lines straight. A lens with distortion looks up, for each of its samples, the place in a
//! pinhole image that is at least as fine everywhere.

use super::sample_grid::SampleGrid;
use crate::geometry::{Camera, Distortion};
use crate::render::error::RenderError;
use crate::render::gpu::Gpu;
use crate::scene::View;
use nalgebra::{Matrix2, Point3, Vector2, Vector3, Vector4};
use rayon::prelude::*;
use wgpu::util::DeviceExt;

/// Widest angle off the axis, as its tangent, that a pinhole image can hold: 80°.
const WIDEST_TANGENT: f64 = 5.67;
/// Samples beside the lens's field, for interpolation.
const MARGIN: f64 = 2.0;
/// Points a side at which the lens's magnification is looked up.
const PROBES: u32 = 33;

/// What is drawn for a camera.
#[derive(Debug)]
pub struct Lens {
    /// Pinhole camera that is drawn.
    pub raster: Camera,
    /// Samples of the pinhole image.
    pub raster_grid: SampleGrid,
    /// Samples of the camera's own image.
    pub grid: SampleGrid,
    /// Focal length in px at the place of the largest magnification.
    pub finest_focal_px: f64,
    /// For each of the camera's samples its place in the pinhole image, in samples; a single zero without distortion.
    pub map: wgpu::TextureView,
}

impl Lens {
    pub fn new(gpu: &Gpu, camera: &Camera, supersampling: u32) -> Result<Self, RenderError> {
        let limit_px = gpu.device.limits().max_texture_dimension_2d;
        let grid = SampleGrid { stride: supersampling, size_px: (camera.width_px, camera.height_px) };
        let fits = |grid: &SampleGrid| grid.size().is_some_and(|(width, height)| width.max(height) <= limit_px);
        let too_large = RenderError::ImageTooLarge {
            width_px: camera.width_px,
            height_px: camera.height_px,
            supersampling,
            limit_px,
        };
        if !fits(&grid) {
            return Err(too_large);
        }
        if camera.distortion == Distortion::None {
            let map = lens_map(gpu, (1, 1), &[[0.0, 0.0]]);
            return Ok(Lens { raster: *camera, raster_grid: grid, grid, finest_focal_px: camera.mean_focal_px(), map });
        }
        let finest = largest_focal_px(camera)?;
        let size = grid.size().expect("the grid fits a texture");
        let ideal = ideal_samples(camera, &grid, size);
        let raster = enclosing_pinhole(&ideal, finest * f64::from(supersampling))?;
        let raster_grid = SampleGrid { stride: 1, size_px: (raster.width_px, raster.height_px) };
        if !fits(&raster_grid) {
            return Err(too_large);
        }
        let place = |p: &Vector2<f64>| {
            let at = p.component_mul(&raster.focal_px) + raster.center_px;
            [at.x as f32, at.y as f32]
        };
        let places: Vec<[f32; 2]> = ideal.par_iter().map(place).collect();
        let map = lens_map(gpu, size, &places);
        Ok(Lens { raster, raster_grid, grid, finest_focal_px: finest, map })
    }

    /// Whether the lens bends what is drawn.
    pub fn is_distorting(&self) -> bool {
        self.raster_grid != self.grid
    }

    /// The rectangle [left, top, width, height] in px of the camera's image that holds all the points (reference frame,
    /// m) and what lies between them; the whole image where the lens bends it or a point lies behind the camera.
    pub fn rectangle_px(&self, view: &View, points_m: &[Vector3<f64>]) -> [u32; 4] {
        let (width, height) = self.grid.size_px;
        let whole = [0, 0, width, height];
        if self.is_distorting() {
            return whole;
        }
        let pixel = |p: &Vector3<f64>| {
            self.raster.project(&view.reference_from_camera.inverse_transform_point(&Point3::from(*p)).coords)
        };
        let Some(pixels) = points_m.iter().map(pixel).collect::<Option<Vec<_>>>() else { return whole };
        // A pixel's samples reach half a pixel from its centre.
        let low = pixels.iter().fold(Vector2::repeat(f64::INFINITY), |low, p| low.inf(p)).add_scalar(-0.5);
        let high = pixels.iter().fold(Vector2::repeat(f64::NEG_INFINITY), |high, p| high.sup(p)).add_scalar(1.5);
        let inside = |at: Vector2<f64>| [at.x.clamp(0.0, f64::from(width)), at.y.clamp(0.0, f64::from(height))];
        let ([left, top], [right, bottom]) = (inside(low.map(f64::floor)), inside(high.map(f64::ceil)));
        [left, top, right - left, bottom - top].map(|side| side as u32)
    }

    /// Focal lengths and principal point in samples of the pinhole image.
    pub fn raster_intrinsics(&self) -> Vector4<f64> {
        let stride = f64::from(self.raster_grid.stride);
        let shift = if self.raster_grid.is_shared() { 0.0 } else { 0.5 };
        let center = self.raster.center_px.map(|c| stride * (c + 0.5) - shift);
        Vector4::new(stride * self.raster.focal_px.x, stride * self.raster.focal_px.y, center.x, center.y)
    }
}

/// Largest derivative of the pixel by ideal coordinates over the image, px.
fn largest_focal_px(camera: &Camera) -> Result<f64, RenderError> {
    let share = |k: u32, size_px: u32| f64::from(k) / f64::from(PROBES - 1) * f64::from(size_px) - 0.5;
    let mut largest: f64 = 0.0;
    for k in 0..PROBES * PROBES {
        let pixel = Vector2::new(share(k % PROBES, camera.width_px), share(k / PROBES, camera.height_px));
        let ideal = camera.normalize(&pixel).ok_or(RenderError::LensTooWide)?;
        let (_, by_ideal) = camera.distortion.distort(&ideal);
        let by_ideal = Matrix2::from_diagonal(&camera.focal_px) * by_ideal;
        largest = largest.max(by_ideal.singular_values().max());
    }
    Ok(largest)
}

/// Ideal coordinates of every sample of the camera's grid, row by row; those outside the invertible field are far away.
fn ideal_samples(camera: &Camera, grid: &SampleGrid, (width, height): (u32, u32)) -> Vec<Vector2<f64>> {
    let row = |v: u32| {
        (0..width).map(move |u| {
            let pixel = grid.pixel_of_sample(u, v);
            camera.normalize(&pixel).unwrap_or(Vector2::repeat(f64::INFINITY))
        })
    };
    (0..height).into_par_iter().flat_map_iter(row).collect()
}

/// The pinhole camera with the given focal length that sees all the ideal coordinates.
fn enclosing_pinhole(ideal: &[Vector2<f64>], focal_px: f64) -> Result<Camera, RenderError> {
    let low = ideal.iter().fold(Vector2::repeat(f64::INFINITY), |low, p| low.inf(p));
    let high = ideal.iter().fold(Vector2::repeat(f64::NEG_INFINITY), |high, p| high.sup(p));
    if low.amax().max(high.amax()) > WIDEST_TANGENT {
        return Err(RenderError::LensTooWide);
    }
    let size = (high - low) * focal_px;
    Ok(Camera {
        width_px: (size.x + 2.0 * MARGIN).ceil() as u32 + 1,
        height_px: (size.y + 2.0 * MARGIN).ceil() as u32 + 1,
        focal_px: Vector2::repeat(focal_px),
        center_px: -low * focal_px + Vector2::repeat(MARGIN),
        distortion: Distortion::None,
    })
}

fn lens_map(gpu: &Gpu, (width, height): (u32, u32), places: &[[f32; 2]]) -> wgpu::TextureView {
    let descriptor = wgpu::TextureDescriptor {
        label: Some("lens"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rg32Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    };
    let order = wgpu::util::TextureDataOrder::LayerMajor;
    let texture = gpu.device.create_texture_with_data(&gpu.queue, &descriptor, order, bytemuck::cast_slice(places));
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
