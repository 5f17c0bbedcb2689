//! Sampling patches.

use image::GrayImage;
use nalgebra::{Matrix2, Vector2};

pub(super) fn halved_difference(from: &[f32], to: &[f32], out: &mut [f32]) {
    out.iter_mut().zip(from).zip(to).for_each(|((value, from), to)| *value = 0.5 * (from - to));
}

/// Dot product in eight strands, which the compiler makes vectors of; always in the same order.
pub(super) fn dot(a: &[f32], b: &[f32]) -> f64 {
    let mut strands = [0.0f32; 8];
    let (a, b) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest: f32 = a.remainder().iter().zip(b.remainder()).map(|(x, y)| x * y).sum();
    for (x, y) in a.zip(b) {
        for k in 0..8 {
            strands[k] += x[k] * y[k];
        }
    }
    strands.iter().map(|s| f64::from(*s)).sum::<f64>() + f64::from(rest)
}

pub(super) fn sum(a: &[f32]) -> f64 {
    let mut strands = [0.0f32; 8];
    let chunks = a.chunks_exact(8);
    let rest: f32 = chunks.remainder().iter().sum();
    for x in chunks {
        for k in 0..8 {
            strands[k] += x[k];
        }
    }
    strands.iter().map(|s| f64::from(*s)).sum::<f64>() + f64::from(rest)
}

/// Grey levels, counted from `zero_dn`, of a square of `2 half + 1` a side about a place, row by row, bilinear; `None` at
/// the edge.
pub(super) fn sample_square(
    image: &GrayImage,
    center_px: &Vector2<f64>,
    (half, zero_dn): (usize, f32),
    out: &mut [f32],
) -> Option<()> {
    let (left, top) = (center_px.x.floor() - half as f64, center_px.y.floor() - half as f64);
    let side = 2 * half + 1;
    let (width, height) = (image.width() as usize, image.height() as usize);
    if left < 0.0 || top < 0.0 || left as usize + side >= width || top as usize + side >= height {
        return None;
    }
    let (s, t) = ((center_px.x - center_px.x.floor()) as f32, (center_px.y - center_px.y.floor()) as f32);
    let weights = [(1.0 - s) * (1.0 - t), s * (1.0 - t), (1.0 - s) * t, s * t];
    for (row, line) in out.chunks_exact_mut(side).enumerate() {
        let at = (top as usize + row) * width + left as usize;
        let (upper, lower) = (&image.as_raw()[at..=at + side], &image.as_raw()[at + width..=at + width + side]);
        for (i, value) in line.iter_mut().enumerate() {
            *value = weights[0] * f32::from(upper[i])
                + weights[1] * f32::from(upper[i + 1])
                + weights[2] * f32::from(lower[i])
                + weights[3] * f32::from(lower[i + 1])
                - zero_dn;
        }
    }
    Some(())
}

/// Grey levels of a warped square of `2 half + 1` a side, row by row, bilinear; `None` at the edge.
pub(super) fn sample_warped(
    image: &GrayImage,
    center_px: &Vector2<f64>,
    linear: &Matrix2<f64>,
    half: usize,
) -> Option<Vec<f32>> {
    let reach = half as f64;
    let corners = [(-reach, -reach), (reach, -reach), (-reach, reach), (reach, reach)];
    let (width, height) = (image.width() as usize, image.height() as usize);
    let inside = |(u, v): &(f64, f64)| {
        let p = center_px + linear * Vector2::new(*u, *v);
        p.x >= 0.0 && p.y >= 0.0 && p.x + 1.0 < width as f64 && p.y + 1.0 < height as f64
    };
    if !corners.iter().all(inside) {
        return None;
    }
    let grey = image.as_raw();
    let side = 2 * half + 1;
    let step = linear.column(0).map(fixed);
    let mut out = vec![0.0; side * side];
    for (row, line) in out.chunks_exact_mut(side).enumerate() {
        let mut at = (center_px + linear * Vector2::new(-reach, row as f64 - reach)).map(fixed);
        for value in line {
            let [u, v] = [at.x, at.y].map(|c| (c >> FRACTION_BITS).max(0) as usize);
            let [s, t] = [at.x, at.y].map(|c| (c & FRACTION) as f32 * (1.0 / (FRACTION + 1) as f32));
            let first = v.min(height - 2) * width + u.min(width - 2);
            let (upper, lower) = (&grey[first..first + 2], &grey[first + width..first + width + 2]);
            let between = |pair: &[u8]| f32::from(pair[0]) + s * (f32::from(pair[1]) - f32::from(pair[0]));
            let (upper, lower) = (between(upper), between(lower));
            *value = upper + t * (lower - upper);
            at += step;
        }
    }
    Some(out)
}

/// Bits behind the point of fixed-point pixels.
const FRACTION_BITS: u32 = 20;

const FRACTION: i64 = (1 << FRACTION_BITS) - 1;

/// A pixel as a fixed-point number: cheaper to step along than a floating-point one, and exact to a millionth.
fn fixed(pixel_px: f64) -> i64 {
    (pixel_px * (FRACTION + 1) as f64).round() as i64
}
