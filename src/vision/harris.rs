//! Harris corners (Harris and Stephens 1988), spread evenly and located to a fraction of a pixel.

use super::evenly::spread_evenly;
use super::opencv_bridge::picture_mat;
use super::{DetectorConfig, VisionError};
use image::GrayImage;
use nalgebra::{Matrix2, Matrix3, Vector2};
use opencv::core::{BORDER_REFLECT_101, CV_32F, Mat, Size};
use opencv::imgproc::{corner_harris, gaussian_blur};
use opencv::prelude::*;

/// A corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Feature {
    /// Pixel (u, v).
    pub pixel_px: Vector2<f64>,
    /// Harris response (grey levels as fractions of 255).
    pub response: f64,
    /// Predicted 1σ of each coordinate in px, from the structure tensor and the picture's noise.
    pub sigma_px: f64,
}

/// What the surface's own change between two pictures costs, px: the error that is left without noise.
const FLOOR_SIGMA_PX: f64 = 0.06;

/// The peak of the Harris response is not the optimal use of the window: ratio to the structure tensor's bound.
const PEAK_FACTOR: f64 = 1.3;

/// Finds at most `max_features` Harris corners of a picture, in order of response; where `mask` is given, only where it
/// is not zero.
///
/// The response comes from a smoothed picture; the corner is the peak of a quadratic through 3×3 responses.
///
/// # Errors
/// A mask of another size, or OpenCV's refusal.
pub fn detect_harris(
    picture: &GrayImage,
    mask: Option<&GrayImage>,
    config: &DetectorConfig,
) -> Result<Vec<Feature>, VisionError> {
    if let Some(mask) = mask.filter(|m| m.dimensions() != picture.dimensions()) {
        let ((mask_width_px, mask_height_px), (width_px, height_px)) = (mask.dimensions(), picture.dimensions());
        return Err(VisionError::MaskSize { mask_width_px, mask_height_px, width_px, height_px });
    }
    let (smooth, response) = responses(picture, config).map_err(VisionError::opencv("compute the Harris response"))?;
    let smooth = smooth.data_typed::<f32>().map_err(VisionError::opencv("read the smoothed picture"))?;
    let response = response.data_typed::<f32>().map_err(VisionError::opencv("read the Harris response"))?;
    let grid = Grid { width: picture.width() as usize, height: picture.height() as usize };
    let noise_dn = noise_sigma_dn(picture);
    let peaks = grid.peaks(response, mask, config);
    let sharp = |at: usize| grid.sigma_px(smooth, at, noise_dn, config.block_px) <= config.max_sigma_px;
    let size = (grid.width, grid.height);
    let chosen = spread_evenly(&peaks, size, config.max_features, config.min_distance_px, sharp);
    let feature = |&(value, at): &(f32, usize)| Feature {
        pixel_px: grid.refine(response, at),
        response: f64::from(value),
        sigma_px: grid.sigma_px(smooth, at, noise_dn, config.block_px),
    };
    Ok(chosen.iter().map(feature).collect())
}

/// The smoothed picture (grey levels / 255) and its Harris response.
fn responses(picture: &GrayImage, config: &DetectorConfig) -> opencv::Result<(Mat, Mat)> {
    let bytes = picture_mat(picture)?;
    let (mut grey, mut smooth, mut response) = (Mat::default(), Mat::default(), Mat::default());
    bytes.convert_to(&mut grey, CV_32F, 1.0 / 255.0, 0.0)?;
    let sigma = config.smoothing_sigma_px;
    gaussian_blur(&grey, &mut smooth, Size::new(0, 0), sigma, sigma, BORDER_REFLECT_101)?;
    corner_harris(&smooth, &mut response, config.block_px as i32, 3, config.harris_k, BORDER_REFLECT_101)?;
    Ok((smooth, response))
}

/// 1σ of the picture's noise in grey levels (Immerkaer 1996), from the lower quartile of the response of a mask that
/// is blind to planes and edges, so that texture counts little; at least the noise of rounding.
pub fn noise_sigma_dn(picture: &GrayImage) -> f64 {
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let p = picture.as_raw();
    let mut histogram = vec![0u32; 4096];
    let mut count = 0u32;
    for y in (1..height.saturating_sub(1)).step_by(3) {
        for x in 1..width.saturating_sub(1) {
            let at = y * width + x;
            let g = |dy: isize, dx: isize| i32::from(p[(at as isize + dy * width as isize + dx) as usize]);
            if g(0, 0) < 4 || g(0, 0) > 251 {
                continue; // empty sky or saturated: no noise to see
            }
            let cross = g(-1, 0) + g(1, 0) + g(0, -1) + g(0, 1);
            let corners = g(-1, -1) + g(-1, 1) + g(1, -1) + g(1, 1);
            histogram[(4 * g(0, 0) - 2 * cross + corners).unsigned_abs() as usize] += 1;
            count += 1;
        }
    }
    let mut seen = 0;
    let quartile = histogram.iter().position(|n| {
        seen += n;
        seen * 4 > count
    });
    const LOWER_QUARTILE_OF_ABSOLUTE_NORMAL: f64 = 0.3186;
    let sigma = quartile.unwrap_or(0) as f64 / (6.0 * LOWER_QUARTILE_OF_ABSOLUTE_NORMAL);
    sigma.max(1.0 / 12f64.sqrt())
}

/// A picture's size, for indexing rows of pixels.
struct Grid {
    width: usize,
    height: usize,
}

impl Grid {
    /// Local maxima of the response as (response, index), strongest first.
    fn peaks(&self, response: &[f32], mask: Option<&GrayImage>, config: &DetectorConfig) -> Vec<(f32, usize)> {
        let strongest = response.iter().copied().fold(0.0, f32::max);
        let least = (strongest * config.min_response_ratio as f32).max(1e-12);
        let border = config.border_px as usize;
        let mut peaks = Vec::new();
        for y in border..self.height.saturating_sub(border) {
            for x in border..self.width.saturating_sub(border) {
                let at = y * self.width + x;
                let value = response[at];
                if value >= least && self.is_peak(response, at) && mask.is_none_or(|m| m.as_raw()[at] != 0) {
                    peaks.push((value, at));
                }
            }
        }
        peaks.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        peaks
    }

    fn is_peak(&self, response: &[f32], at: usize) -> bool {
        let value = response[at];
        let w = self.width;
        // Ties go to the first in reading order.
        let before = [at - w - 1, at - w, at - w + 1, at - 1];
        let after = [at + 1, at + w - 1, at + w, at + w + 1];
        before.iter().all(|&i| response[i] < value) && after.iter().all(|&i| response[i] <= value)
    }

    /// Peak of the least-squares quadratic through the 3×3 responses about a maximum, at most 1 px away.
    fn refine(&self, response: &[f32], at: usize) -> Vector2<f64> {
        let whole = Vector2::new((at % self.width) as f64, (at / self.width) as f64);
        let r = Matrix3::from_fn(|row, column| f64::from(response[at + row * self.width + column - self.width - 1]));
        let column = |j: usize| r.column(j).sum();
        let row = |i: usize| r.row(i).sum();
        let gradient = Vector2::new(column(2) - column(0), row(2) - row(0)) / 6.0;
        let curvature_u = (column(0) - 2.0 * column(1) + column(2)) / 3.0;
        let curvature_v = (row(0) - 2.0 * row(1) + row(2)) / 3.0;
        let cross = (r[(2, 2)] + r[(0, 0)] - r[(2, 0)] - r[(0, 2)]) / 4.0;
        let curvature = Matrix2::new(curvature_u, cross, cross, curvature_v);
        match curvature.try_inverse() {
            Some(inverse) if curvature_u < 0.0 && curvature.determinant() > 0.0 => {
                let step = -(inverse * gradient);
                if step.amax() <= 1.0 { whole + step } else { whole }
            }
            _ => whole,
        }
    }

    /// Predicted 1σ of a corner in px: noise through the structure tensor, and the floor.
    fn sigma_px(&self, smooth: &[f32], at: usize, noise_dn: f64, block_px: u32) -> f64 {
        let half = (block_px / 2) as usize;
        let mut tensor = Matrix2::zeros();
        for y in at / self.width - half..=at / self.width + half {
            for x in at % self.width - half..=at % self.width + half {
                let i = y * self.width + x;
                let slope = |a: usize, b: usize| f64::from(smooth[a] - smooth[b]) * 127.5;
                let g = Vector2::new(slope(i + 1, i - 1), slope(i + self.width, i - self.width));
                tensor += g * g.transpose();
            }
        }
        let bound = tensor.try_inverse().map_or(f64::INFINITY, |inverse| inverse.trace() * 0.5);
        (FLOOR_SIGMA_PX.powi(2) + (PEAK_FACTOR * noise_dn).powi(2) * bound).sqrt()
    }
}
