//! Images to look at: tracks drawn over a frame, and contact sheets.

use crate::observations::TrackObservation;
use image::{GrayImage, Rgb, RgbImage, imageops};
use imageproc::drawing::{draw_antialiased_line_segment_mut, draw_hollow_circle_mut, draw_line_segment_mut};
use imageproc::pixelops::interpolate;
use nalgebra::Vector2;
use std::collections::HashMap;

const FRESH: Rgb<u8> = Rgb([90, 200, 255]);
const TRACKED: Rgb<u8> = Rgb([120, 255, 90]);
const FLOW: Rgb<u8> = Rgb([255, 210, 60]);
const DESIGNATED: Rgb<u8> = Rgb([255, 60, 60]);

/// Draws the tracks of one frame: a circle a track, a line from where the same track was in the frame before (new tracks
/// are blue), and a cross with a 3σ circle at the designated point.
pub fn draw_tracks(
    image: &GrayImage,
    observations: &[TrackObservation],
    previous_px: &HashMap<u64, Vector2<f64>>,
    designated: Option<&TrackObservation>,
) -> RgbImage {
    let mut canvas: RgbImage = image::DynamicImage::ImageLuma8(image.clone()).to_rgb8();
    for o in observations.iter().filter(|o| o.track_id != TrackObservation::DESIGNATED) {
        let before = previous_px.get(&o.track_id);
        if let Some(before) = before {
            draw_antialiased_line_segment_mut(&mut canvas, whole(before), whole(&o.pixel_px), FLOW, interpolate);
        }
        draw_hollow_circle_mut(&mut canvas, whole(&o.pixel_px), 2, if before.is_some() { TRACKED } else { FRESH });
    }
    if let Some(o) = designated {
        let radius = (3.0 * o.sigma_px).clamp(6.0, 400.0);
        let (p, arm) = ((o.pixel_px.x as f32, o.pixel_px.y as f32), 14.0);
        draw_hollow_circle_mut(&mut canvas, whole(&o.pixel_px), radius.round() as i32, DESIGNATED);
        draw_line_segment_mut(&mut canvas, (p.0 - arm, p.1), (p.0 + arm, p.1), DESIGNATED);
        draw_line_segment_mut(&mut canvas, (p.0, p.1 - arm), (p.0, p.1 + arm), DESIGNATED);
    }
    canvas
}

fn whole(pixel_px: &Vector2<f64>) -> (i32, i32) {
    (pixel_px.x.round() as i32, pixel_px.y.round() as i32)
}

/// Puts images side by side in rows of `columns`, each shrunk to `width_px`, with a thin gap.
pub fn contact_sheet(images: &[RgbImage], columns: usize, width_px: u32) -> RgbImage {
    const GAP_PX: u32 = 4;
    let columns = columns.clamp(1, images.len().max(1)) as u32;
    let tallest = |p: &RgbImage| (p.height() * width_px).div_ceil(p.width().max(1));
    let height_px = images.iter().map(tallest).max().unwrap_or(1).max(1);
    let rows = (images.len() as u32).div_ceil(columns).max(1);
    let (pitch_u, pitch_v) = (width_px + GAP_PX, height_px + GAP_PX);
    let mut sheet = RgbImage::from_pixel(columns * pitch_u - GAP_PX, rows * pitch_v - GAP_PX, Rgb([24, 24, 24]));
    for (index, image) in images.iter().enumerate() {
        let small = imageops::resize(image, width_px, tallest(image).max(1), imageops::FilterType::Triangle);
        let (column, row) = (index as u32 % columns, index as u32 / columns);
        imageops::replace(&mut sheet, &small, i64::from(column * pitch_u), i64::from(row * pitch_v));
    }
    sheet
}
