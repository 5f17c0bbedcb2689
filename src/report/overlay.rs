//! Features drawn into a picture.

use super::ReportError;
use image::{GrayImage, Rgb, RgbImage};
use imageproc::drawing::{draw_hollow_circle_mut, draw_line_segment_mut};
use nalgebra::Vector2;
use std::io::Cursor;

/// What a mark stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MarkKind {
    /// A tracked feature.
    Feature,
    /// The designated landing point.
    Designated,
    /// A feature that was thrown out.
    Outlier,
}

/// A feature to draw.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeatureMark {
    /// Pixel (u, v) in this picture.
    pub pixel_px: Vector2<f64>,
    /// Pixel in the picture before, where it is known: drawn as a trail.
    pub before_px: Option<Vector2<f64>>,
    /// What it stands for.
    pub kind: MarkKind,
}

/// The picture in grey with a circle on each feature and a trail from where it was; a cross on the designated point.
pub fn draw_features(picture: &GrayImage, marks: &[FeatureMark]) -> RgbImage {
    let mut drawn = image::DynamicImage::ImageLuma8(picture.clone()).to_rgb8();
    let scale = (f64::from(picture.width()) / 400.0).max(1.0);
    // Pages show pictures smaller than they are: thin lines would vanish.
    let bold = picture.width() >= 400;
    for mark in marks {
        let color = match mark.kind {
            MarkKind::Feature => Rgb([255, 196, 64]),
            MarkKind::Designated => Rgb([255, 80, 80]),
            MarkKind::Outlier => Rgb([120, 150, 170]),
        };
        if let Some(before) = mark.before_px {
            draw_trail(&mut drawn, &before, &mark.pixel_px, bold);
        }
        let center = (mark.pixel_px.x.round() as i32, mark.pixel_px.y.round() as i32);
        match mark.kind {
            MarkKind::Designated => draw_cross(&mut drawn, &mark.pixel_px, 9.0 * scale, color),
            MarkKind::Feature | MarkKind::Outlier => {
                let radius = (3.0 * scale).round() as i32;
                for ring in 0..=i32::from(bold) {
                    draw_hollow_circle_mut(&mut drawn, center, radius + ring, color);
                }
            }
        }
    }
    drawn
}

fn draw_trail(drawn: &mut RgbImage, from: &Vector2<f64>, to: &Vector2<f64>, bold: bool) {
    for offset in 0..=i32::from(bold) {
        let shift = Vector2::repeat(f64::from(offset));
        draw_line_segment_mut(drawn, single(&(from + shift)), single(&(to + shift)), Rgb([80, 200, 255]));
    }
}

/// A cross with an open middle, three lines wide so that it is found at a glance.
fn draw_cross(drawn: &mut RgbImage, center: &Vector2<f64>, reach: f64, color: Rgb<u8>) {
    for (along, across) in [(Vector2::x(), Vector2::y()), (Vector2::y(), Vector2::x())] {
        for side in [-1.0, 1.0] {
            for offset in [-1.0, 0.0, 1.0] {
                let shift: Vector2<f64> = center + across * offset;
                let (inner, outer) = (shift + along * (side * 0.3 * reach), shift + along * (side * reach));
                draw_line_segment_mut(drawn, single(&inner), single(&outer), color);
            }
        }
    }
}

fn single(pixel: &Vector2<f64>) -> (f32, f32) {
    (pixel.x as f32, pixel.y as f32)
}

/// PNG bytes of a picture, made smaller if it is wider than `most_px`.
///
/// # Errors
/// [`ReportError::Picture`] if it cannot be encoded, such as an empty one.
pub fn picture_png(picture: &RgbImage, most_px: u32) -> Result<Vec<u8>, ReportError> {
    let mut bytes = Cursor::new(Vec::new());
    if picture.width() > most_px && most_px > 0 {
        let height = (u64::from(picture.height()) * u64::from(most_px) / u64::from(picture.width())).max(1) as u32;
        let small = image::imageops::resize(picture, most_px, height, image::imageops::FilterType::Triangle);
        small.write_to(&mut bytes, image::ImageFormat::Png)?;
    } else {
        picture.write_to(&mut bytes, image::ImageFormat::Png)?;
    }
    Ok(bytes.into_inner())
}
