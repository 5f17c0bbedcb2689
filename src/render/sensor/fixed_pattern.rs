//! Fixed pattern: what differs from pixel to pixel and stays from image to image.

use crate::scene::SensorConfig;
use rand::{Rng, RngExt};
use rand_distr::{Distribution, Exp1, StandardNormal};

/// One pixel's part of the pattern.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pixel {
    /// Sensitivity over the mean (EMVA 1288's PRNU).
    pub response: f32,
    /// Offset in electrons, whatever the exposure time (EMVA 1288's DSNU).
    pub offset_electrons: f32,
    /// Electrons that dark current is expected to free during the exposure.
    pub dark_electrons: f32,
}

/// The pattern of a detector.
#[derive(Debug, Clone)]
pub(super) struct FixedPattern {
    usual: Pixel,
    /// Empty if all pixels are alike.
    pixels: Vec<Pixel>,
}

impl FixedPattern {
    pub(super) fn new(config: &SensorConfig, pixels: usize, random: &mut impl Rng) -> Self {
        let pattern = &config.fixed_pattern;
        let time_s = config.shutter.exposure_time_s;
        let dark_electrons = (config.dark_current_electrons_s * time_s) as f32;
        let usual = Pixel { response: 1.0, offset_electrons: 0.0, dark_electrons };
        if pattern.response_sigma == 0.0 && pattern.offset_sigma_electrons == 0.0 && pattern.hot_pixel_fraction == 0.0 {
            return FixedPattern { usual, pixels: Vec::new() };
        }
        let mut draw = || {
            let response: f64 = StandardNormal.sample(random);
            let offset: f64 = StandardNormal.sample(random);
            let hot = random.random_bool(pattern.hot_pixel_fraction);
            let hot_rate: f64 = if hot { Exp1.sample(random) } else { 0.0 };
            Pixel {
                response: (1.0 + pattern.response_sigma * response).max(0.0) as f32,
                offset_electrons: (pattern.offset_sigma_electrons * offset) as f32,
                dark_electrons: dark_electrons + (pattern.hot_pixel_electrons_s * hot_rate * time_s) as f32,
            }
        };
        FixedPattern { usual, pixels: (0..pixels).map(|_| draw()).collect() }
    }

    /// The pixel of an index.
    pub(super) fn pixel(&self, index: usize) -> Pixel {
        self.pixels.get(index).copied().unwrap_or(self.usual)
    }
}
