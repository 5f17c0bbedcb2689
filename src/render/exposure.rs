//! Motion during the exposure: one image as the mean of images at other moments, each row at its own times.

use super::error::RenderError;
use super::frame::RenderedFrame;
use super::optics::SubImages;
use super::renderer::Renderer;
use crate::geometry::Camera;
use crate::scene::{ShutterConfig, View};
use nalgebra::{Point3, Vector2};

/// Pixels between the places where motion is looked at.
const MOTION_GRID_PX: u32 = 16;

impl Renderer {
    /// Renders what a shutter collects around the time stamp, the middle of the exposure of the middle row. `view_at`
    /// gives the view at any time in ns.
    ///
    /// Depth and mask are those of the time stamp. The radiance is a mean over images at other times, near enough to one
    /// another that nothing moves by more than half a pixel between them, unless that took more than
    /// [`ShutterConfig::sub_pictures_at_most`]. Without exposure time and row time, or where nothing moves, the image is
    /// that of [`Renderer::render`].
    ///
    /// # Errors
    /// As [`Renderer::render`], for any of the moments.
    pub fn expose(
        &mut self,
        shutter: &ShutterConfig,
        t_ns: i64,
        view_at: &dyn Fn(i64) -> View,
    ) -> Result<RenderedFrame, RenderError> {
        let still = self.render(&view_at(t_ns))?;
        let span_s = SubImages::span_s(shutter, still.height_px);
        if !shutter.motion || span_s == 0.0 {
            return Ok(still);
        }
        let at = |offset_s: f64| view_at(t_ns + (offset_s * 1e9).round() as i64);
        let views = [-0.5, 0.0, 0.5].map(|share| at(share * span_s));
        let motion_px = motion_px(self.camera(), &still, &views);
        let sub_images = SubImages::new(shutter, still.height_px, motion_px);
        let mut radiance = vec![0.0; still.radiance.len()];
        for (index, offset_s) in sub_images.offsets_s.iter().enumerate() {
            let weights = |row: usize| sub_images.weight(index, row);
            match *offset_s == 0.0 {
                true => add_weighted(&mut radiance, &still, &weights),
                false => add_weighted(&mut radiance, &self.render(&at(*offset_s))?, &weights),
            }
        }
        Ok(RenderedFrame { radiance, ..still })
    }
}

fn add_weighted(sum: &mut [f32], frame: &RenderedFrame, weight_of_row: &dyn Fn(usize) -> f32) {
    let width = frame.width_px as usize;
    for (row, (sum, radiance)) in sum.chunks_mut(width).zip(frame.radiance.chunks(width)).enumerate() {
        let weight = weight_of_row(row);
        if weight > 0.0 {
            sum.iter_mut().zip(radiance).for_each(|(sum, value)| *sum += weight * value);
        }
    }
}

/// Longest way in px that a point of the surface goes across the image through three views; the second is that of the
/// frame. 0 if the frame shows no surface.
fn motion_px(camera: &Camera, frame: &RenderedFrame, [before, middle, after]: &[View; 3]) -> f64 {
    let grid = |size_px: u32| (0..size_px).step_by(MOTION_GRID_PX as usize);
    let way_px = |u: u32, v: u32| -> Option<f64> {
        let depth_m = Some(f64::from(frame.depth_m[frame.index(u, v)])).filter(|depth_m| depth_m.is_finite())?;
        let pixel_px = Vector2::new(f64::from(u), f64::from(v));
        let ideal = camera.normalize(&pixel_px)?;
        let point = middle.reference_from_camera * Point3::from(ideal.push(1.0) * depth_m);
        let seen = |view: &View| camera.project(&view.reference_from_camera.inverse_transform_point(&point).coords);
        Some((seen(before)? - pixel_px).norm() + (seen(after)? - pixel_px).norm())
    };
    let pixels = grid(frame.height_px).flat_map(|v| grid(frame.width_px).map(move |u| (u, v)));
    pixels.filter_map(|(u, v)| way_px(u, v)).fold(0.0, f64::max)
}
