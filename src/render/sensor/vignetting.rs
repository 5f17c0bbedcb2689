//! Vignetting: from radiance to irradiance.

use crate::geometry::Camera;
use crate::scene::VignettingConfig;
use nalgebra::Vector2;
use rayon::prelude::*;

/// Relative illumination of each pixel.
#[derive(Debug, Clone)]
pub(super) struct Vignetting {
    /// Empty if it is 1 everywhere.
    factors: Vec<f32>,
}

impl Vignetting {
    pub(super) fn new(camera: &Camera, config: &VignettingConfig) -> Self {
        if !config.is_on() {
            return Vignetting { factors: Vec::new() };
        }
        let half_diagonal_px = 0.5 * f64::from(camera.width_px).hypot(f64::from(camera.height_px));
        let factor = |index: usize| {
            let (row, column) = (index / camera.width_px as usize, index % camera.width_px as usize);
            let pixel_px = Vector2::new(column as f64, row as f64);
            let r_squared = ((pixel_px - camera.center_px) / half_diagonal_px).norm_squared();
            // Where no ray comes from, no light comes from.
            let cosine = || camera.unproject(&pixel_px).map_or(0.0, |bearing| bearing.z);
            let fourth = if config.cosine_fourth { cosine().powi(4) } else { 1.0 };
            (fourth * config.radial_factor(r_squared).max(0.0)) as f32
        };
        let pixels = camera.width_px as usize * camera.height_px as usize;
        Vignetting { factors: (0..pixels).into_par_iter().map(factor).collect() }
    }

    /// Irradiance of an image of radiance, in the same unit (I/F).
    pub(super) fn applied(&self, radiance: &[f32]) -> Vec<f32> {
        if self.factors.is_empty() {
            return radiance.to_vec();
        }
        assert_eq!(self.factors.len(), radiance.len(), "a frame of the camera's size");
        radiance.iter().zip(&self.factors).map(|(radiance, factor)| radiance * factor).collect()
    }
}
