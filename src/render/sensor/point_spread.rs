//! Point spread of the optics: a Gaussian and the disc of defocus.
//!
//! Both kernels sum to 1, so the light of a point that they keep inside the image is all kept. Beyond the edge the
//! scene is unknown: the image's outermost pixels are repeated there, which keeps an even field even.

use rayon::prelude::*;

/// Weight of a Gaussian kernel that may be cut off on either side.
const CUT_OFF: f64 = 1e-7;
/// Samples a pixel and axis that find the share of a pixel under the disc.
const DISC_SAMPLES: i32 = 32;

/// Kernels.
#[derive(Debug, Clone)]
pub(super) struct PointSpread {
    /// Weights from -n to n along either axis; one weight if there is no blur.
    gaussian: Vec<f32>,
    /// Rows of a square kernel; one weight if there is no defocus.
    disc: Vec<Vec<f32>>,
}

impl PointSpread {
    pub(super) fn new(sigma_px: f64, defocus_radius_px: f64) -> Self {
        PointSpread { gaussian: gaussian_kernel(sigma_px), disc: disc_kernel(defocus_radius_px) }
    }

    /// The image spread by both kernels; rows of `width` values.
    pub(super) fn applied(&self, mut image: Vec<f32>, width: usize) -> Vec<f32> {
        if self.disc.len() > 1 {
            image = convolved(&image, width, |row| disc_row(&image, width, row, &self.disc));
        }
        if self.gaussian.len() > 1 {
            image = convolved(&image, width, |row| gaussian_row(&image, width, row, &self.gaussian));
        }
        image
    }
}

/// Weights of Lindeberg's discrete Gaussian (1990), e⁻ᵗ Iₙ(t) with t = σ²: its second moment is σ² exactly, for narrow
/// kernels too. The Bessel function is its integral over the circle, (1/π) ∫ exp(t (cos θ - 1)) cos nθ dθ, which equal
/// steps give to the last digit.
fn gaussian_kernel(sigma_px: f64) -> Vec<f32> {
    const STEPS: u32 = 512;
    let variance = sigma_px * sigma_px;
    let angle = |step: u32| std::f64::consts::TAU * f64::from(step) / f64::from(STEPS);
    let weight = |n: f64| {
        let term = |step: u32| (variance * (angle(step).cos() - 1.0)).exp() * (n * angle(step)).cos();
        (0..STEPS).map(term).sum::<f64>() / f64::from(STEPS)
    };
    let mut side = vec![weight(0.0)];
    let mut left = 0.5 * (1.0 - side[0]);
    while left > CUT_OFF && side.len() < (STEPS / 4) as usize {
        side.push(weight(side.len() as f64));
        left -= side[side.len() - 1];
    }
    let whole: Vec<f64> = side.iter().skip(1).rev().chain(&side).copied().collect();
    normalised(&whole)
}

/// Share of each pixel that a disc around the middle pixel's centre covers.
fn disc_kernel(radius_px: f64) -> Vec<Vec<f32>> {
    let reach = (radius_px - 0.5).ceil().max(0.0) as i32;
    if radius_px <= 0.0 {
        return vec![vec![1.0]];
    }
    let fine = |pixel: i32, sample: i32| f64::from(pixel) - 0.5 + (f64::from(sample) + 0.5) / f64::from(DISC_SAMPLES);
    let covered = |u: i32, v: i32| {
        let inside = |a: i32| (0..DISC_SAMPLES).filter(|b| fine(u, a).hypot(fine(v, *b)) <= radius_px).count();
        (0..DISC_SAMPLES).map(inside).sum::<usize>() as f64
    };
    let square: Vec<f64> = (-reach..=reach).flat_map(|v| (-reach..=reach).map(move |u| covered(u, v))).collect();
    normalised(&square).chunks((2 * reach + 1) as usize).map(<[f32]>::to_vec).collect()
}

fn normalised(weights: &[f64]) -> Vec<f32> {
    let sum: f64 = weights.iter().sum();
    weights.iter().map(|weight| (weight / sum) as f32).collect()
}

/// An image of the rows that a function makes, in parallel.
fn convolved(image: &[f32], width: usize, row: impl Fn(usize) -> Vec<f32> + Sync) -> Vec<f32> {
    let mut out = vec![0.0; image.len()];
    out.par_chunks_mut(width).enumerate().for_each(|(index, values)| values.copy_from_slice(&row(index)));
    out
}

/// One row spread along both axes: down the columns, then along the row.
fn gaussian_row(image: &[f32], width: usize, row: usize, kernel: &[f32]) -> Vec<f32> {
    let reach = kernel.len() / 2;
    let mut mixed = vec![0.0; width];
    for (weight, offset) in kernel.iter().zip(-(reach as isize)..) {
        add_scaled(&mut mixed, *weight, image_row(image, width, row, offset));
    }
    let mixed = padded(&mixed, reach);
    let mut out = vec![0.0; width];
    for (shift, weight) in kernel.iter().enumerate() {
        add_scaled(&mut out, *weight, &mixed[shift..shift + width]);
    }
    out
}

/// One row spread by a square kernel.
fn disc_row(image: &[f32], width: usize, row: usize, kernel: &[Vec<f32>]) -> Vec<f32> {
    let reach = kernel.len() / 2;
    let mut out = vec![0.0; width];
    for (weights, offset) in kernel.iter().zip(-(reach as isize)..) {
        let source = padded(image_row(image, width, row, offset), reach);
        for (shift, weight) in weights.iter().enumerate().filter(|(_, weight)| **weight > 0.0) {
            add_scaled(&mut out, *weight, &source[shift..shift + width]);
        }
    }
    out
}

/// The row at an offset, the outermost row beyond the edge.
fn image_row(image: &[f32], width: usize, row: usize, offset: isize) -> &[f32] {
    let rows = image.len() / width;
    let row = row.saturating_add_signed(offset).min(rows - 1);
    &image[row * width..(row + 1) * width]
}

/// A row with its outermost values repeated on either side.
fn padded(row: &[f32], reach: usize) -> Vec<f32> {
    let mut out = vec![row[0]; reach];
    out.extend_from_slice(row);
    out.extend(std::iter::repeat_n(row[row.len() - 1], reach));
    out
}

fn add_scaled(out: &mut [f32], weight: f32, values: &[f32]) {
    out.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * value);
}
