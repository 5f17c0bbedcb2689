//! Where the samples of an image lie.

use crate::geometry::Camera;
use nalgebra::{Matrix4, Vector2};

/// A grid of samples, `stride` a pixel and axis, one of which lies at every pixel's centre: what the image shows there
/// is the truth. A pixel is the mean of its square by the midpoint rule (odd strides) or by the trapezoidal rule, whose
/// outer samples are shared with the pixels beside it (even strides).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SampleGrid {
    /// Samples a pixel and axis.
    pub stride: u32,
    /// Image width and height in px.
    pub size_px: (u32, u32),
}

impl SampleGrid {
    /// Samples along each side of a pixel's square: odd, so that the middle one is the pixel's centre.
    pub fn taps(&self) -> u32 {
        self.stride + u32::from(self.is_shared())
    }

    /// Whether pixels share their outer samples.
    pub fn is_shared(&self) -> bool {
        self.stride.is_multiple_of(2)
    }

    /// Width and height in samples; `None` beyond 32 bits.
    pub fn size(&self) -> Option<(u32, u32)> {
        let along = |size_px: u32| self.stride.checked_mul(size_px)?.checked_add(u32::from(self.is_shared()));
        Some((along(self.size_px.0)?, along(self.size_px.1)?))
    }

    /// Pixel coordinates of a sample.
    pub fn pixel_of_sample(&self, column: u32, row: u32) -> Vector2<f64> {
        let shift = if self.is_shared() { 0.0 } else { 0.5 };
        Vector2::new(f64::from(column), f64::from(row)).map(|i| (i + shift) / f64::from(self.stride) - 0.5)
    }

    /// Reversed, infinite projection: depth is `NEAR_M / z`. Sample i of a shared grid lies at pixel i/stride - 1/2, of
    /// another at (i + 1/2)/stride - 1/2; a target's sample i lies at i + 1/2.
    pub fn clip_from_camera(&self, camera: &Camera) -> Matrix4<f64> {
        let shift = if self.is_shared() { 0.5 } else { 0.0 };
        let axis = |size_px: u32, focal_px: f64, center_px: f64| {
            let stride = f64::from(self.stride);
            let size = stride * f64::from(size_px) + 2.0 * shift;
            (2.0 * stride * focal_px / size, 2.0 * (stride * (center_px + 0.5) + shift) / size - 1.0)
        };
        let (x, x_shift) = axis(self.size_px.0, camera.focal_px.x, camera.center_px.x);
        let (y, y_shift) = axis(self.size_px.1, camera.focal_px.y, camera.center_px.y);
        #[rustfmt::skip]
        let matrix = Matrix4::new(
            x, 0.0, x_shift, 0.0,
            0.0, -y, -y_shift, 0.0,
            0.0, 0.0, 0.0, NEAR_M,
            0.0, 0.0, 1.0, 0.0,
        );
        matrix
    }
}

/// Nearest depth in m that is drawn.
const NEAR_M: f64 = 0.005;
