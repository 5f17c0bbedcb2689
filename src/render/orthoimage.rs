//! Orthoimages: images from straight above, resampled to a grid on the ground.

use super::RenderConfig;
use super::error::RenderError;
use super::frame::RenderedFrame;
use super::gpu::Gpu;
use super::renderer::Renderer;
use super::world::World;
use crate::dataset::MapLevel;
use crate::geometry::Camera;
use crate::scene::{SurveyLevel, Terrain, View};
use image::ImageBuffer;
use nalgebra::{Unit, Vector2, Vector3};
use rayon::prelude::*;

/// Edge of the shadow map in texels: about as many as the image has samples.
const SHADOW_MAP_PX: u32 = 4096;
/// Least distance between the ground's vertices, px: a map's squares are wider than images, and their ground has to fit
/// into the adapter's buffers.
const VERTEX_SPACING_PX: f64 = 1.1;
/// 1σ of the place of what an orthoimage shows, px: what resampling and details that one level of the ground shows and
/// another one does not leave open.
const SIGMA_PX: f64 = 0.05;
/// Radiance (I/F) that becomes the largest number: that of a white, sunlit surface.
const WHITE: f32 = 1.0;

/// One level of a map of the terrain under a Sun (direction in the site frame, angular radius in rad), without noise.
///
/// # Errors
/// [`RenderError`] if the level is larger than the adapter's images, or the Sun is below the horizon.
pub fn map_level(
    gpu: &Gpu,
    terrain: &Terrain,
    (sun_in_site, sun_angular_radius_rad): (Unit<Vector3<f64>>, f64),
    (level, config): (&SurveyLevel, &RenderConfig),
) -> Result<MapLevel, RenderError> {
    let heights_m = level.heights_m(terrain);
    let relief_m = heights_m.iter().fold(0.0f32, |most, height| most.max(height.abs()));
    let camera = level.camera(f64::from(relief_m));
    let view = View {
        t_ns: 0,
        reference_from_camera: level.site_from_camera(),
        sun_in_reference: sun_in_site,
        sun_angular_radius_rad,
    };
    let vertex_spacing_px = config.vertex_spacing_px.max(VERTEX_SPACING_PX);
    let config = RenderConfig { shadow_map_px: SHADOW_MAP_PX, surface_truth: false, vertex_spacing_px, ..*config };
    let frame = Renderer::new(gpu, World::Terrain(terrain), &camera, &config)?.render(&view)?;
    let numbers = orthorectified(&frame, (&camera, &view), level, &heights_m);
    let posts = level.posts() as u32;
    Ok(MapLevel {
        metres_per_px: level.metres_per_px,
        first_in_site_m: level.first_in_site_m(),
        image: ImageBuffer::from_raw(posts, posts, numbers).expect("one number a post"),
        sigma_horizontal_m: SIGMA_PX * level.metres_per_px,
        sigma_vertical_m: level.height_error_m(terrain, &heights_m),
        heights_m,
    })
}

/// The image at each post's place and height, bilinear; 0 where it does not reach.
fn orthorectified(
    frame: &RenderedFrame,
    (camera, view): (&Camera, &View),
    level: &SurveyLevel,
    heights_m: &[f32],
) -> Vec<u16> {
    let posts = level.posts();
    let camera_from_site = view.reference_from_camera.inverse();
    let number = |(index, height_m): (usize, &f32)| {
        let place_m = level.place_m((index % posts) as f64, (index / posts) as f64);
        let in_camera_m = camera_from_site.transform_point(&place_m.push(f64::from(*height_m)).into()).coords;
        let radiance = camera.project(&in_camera_m).and_then(|pixel_px| bilinear(frame, &pixel_px)).unwrap_or(0.0);
        (radiance / WHITE * f32::from(u16::MAX)).round().clamp(0.0, f32::from(u16::MAX)) as u16
    };
    heights_m.par_iter().enumerate().map(number).collect()
}

fn bilinear(frame: &RenderedFrame, pixel_px: &Vector2<f64>) -> Option<f32> {
    let (u, v) = (pixel_px.x.floor(), pixel_px.y.floor());
    if u < 0.0 || v < 0.0 || u as u32 + 1 >= frame.width_px || v as u32 + 1 >= frame.height_px {
        return None;
    }
    let (s, t) = ((pixel_px.x - u) as f32, (pixel_px.y - v) as f32);
    let at = |du: u32, dv: u32| frame.radiance[frame.index(u as u32 + du, v as u32 + dv)];
    let along = |dv: u32| at(0, dv) * (1.0 - s) + at(1, dv) * s;
    Some(along(0) * (1.0 - t) + along(1) * t)
}
