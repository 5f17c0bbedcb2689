//! Peaks of a corner response: where exactly, how blunt, and how well known.

use super::config::DetectorConfig;
use super::detector::PeakModel;
use nalgebra::{Matrix2, Matrix3, Vector2};

/// An image's responses, row by row.
pub(super) struct Grid<'a> {
    pub(super) width: usize,
    /// Smoothed grey levels over 255.
    pub(super) smooth: &'a [f32],
    pub(super) response: &'a [f32],
    /// 1σ of the image's noise in grey levels.
    pub(super) noise_dn: f64,
    pub(super) model: &'a PeakModel,
}

/// A peak of the response.
pub(super) struct Peak {
    at: usize,
    pub(super) pixel_px: Vector2<f64>,
    pub(super) response: f64,
    /// −response · (second derivatives)⁻¹ of the response to the fourth power, px².
    spread_px2: Matrix2<f64>,
}

impl Peak {
    /// How far from the peak the response would vanish at the curvature of the top, over √2; mean of both axes, px.
    pub(super) fn width_px(&self) -> f64 {
        (0.5 * self.spread_px2.trace()).sqrt()
    }
}

impl Grid<'_> {
    /// Peak of the least-squares quadratic through the 3×3 responses about a maximum; `None` where it has none within 1 px.
    pub(super) fn peak(&self, at: usize) -> Option<Peak> {
        let whole = Vector2::new((at % self.width) as f64, (at / self.width) as f64);
        let r = Matrix3::from_fn(|j, i| f64::from(self.response[at + j * self.width + i - self.width - 1]));
        let (column, row) = (|i: usize| r.column(i).sum(), |j: usize| r.row(j).sum());
        let gradient = Vector2::new(column(2) - column(0), row(2) - row(0)) / 6.0;
        let along_u = (column(0) - 2.0 * column(1) + column(2)) / 3.0;
        let along_v = (row(0) - 2.0 * row(1) + row(2)) / 3.0;
        let across = (r[(2, 2)] + r[(0, 0)] - r[(2, 0)] - r[(0, 2)]) / 4.0;
        let curvature = Matrix2::new(along_u, across, across, along_v);
        let inverse = curvature.try_inverse().filter(|_| along_u < 0.0 && curvature.determinant() > 0.0)?;
        let step = -(inverse * gradient);
        let spread_px2 = -inverse * r[(1, 1)] * self.model.share();
        let peak = Peak { at, pixel_px: whole + step, response: r[(1, 1)], spread_px2 };
        (step.amax() <= 1.0).then_some(peak)
    }

    /// Covariance of a peak in px². Whatever tilts the response moves its peak by the tilt times the spread.
    pub(super) fn covariance_px2(&self, peak: &Peak, config: &DetectorConfig) -> Matrix2<f64> {
        let change_per_px = config.noise.change_per_px * self.model.change_over_harris;
        let by_change = peak.spread_px2 * peak.spread_px2 * change_per_px.powi(2);
        let bound = self.tensor_dn2(peak.at, config.block_px).try_inverse();
        let noise_dn = config.noise.noise_factor * self.model.noise_over_harris * self.noise_dn;
        let by_noise = bound.unwrap_or(Matrix2::identity() * f64::INFINITY) * noise_dn.powi(2);
        by_change + by_noise
    }

    /// Structure tensor of the smoothed image over a block, in squared grey levels.
    fn tensor_dn2(&self, at: usize, block_px: u32) -> Matrix2<f64> {
        let half = (block_px / 2) as usize;
        let mut tensor = Matrix2::zeros();
        for y in at / self.width - half..=at / self.width + half {
            for x in at % self.width - half..=at % self.width + half {
                let i = y * self.width + x;
                let slope = |a: usize, b: usize| f64::from(self.smooth[a] - self.smooth[b]) * 127.5;
                let g = Vector2::new(slope(i + 1, i - 1), slope(i + self.width, i - self.width));
                tensor += g * g.transpose();
            }
        }
        tensor
    }
}
