//! The chain of stages.

use super::exposure_level::electrons_per_irradiance;
use super::fixed_pattern::FixedPattern;
use super::point_spread::PointSpread;
use super::read_out::ReadOut;
use super::shot_noise::shot;
use super::vignetting::Vignetting;
use crate::dataset::GreyRaster;
use crate::geometry::Camera;
use crate::render::frame::RenderedFrame;
use crate::scene::SensorConfig;
use crate::stats::{random_stream, sub_stream};
use rand::Rng;
use rayon::prelude::*;

/// The detector of one camera.
#[derive(Debug, Clone)]
pub struct Detector {
    config: SensorConfig,
    seed: u64,
    stream_name: String,
    vignetting: Vignetting,
    point_spread: PointSpread,
    fixed_pattern: FixedPattern,
    read_out: ReadOut,
}

impl Detector {
    /// Detector of a camera. Each `number` has a fixed pattern and noise of its own.
    pub fn new(camera: &Camera, config: &SensorConfig, seed: u64, number: u64) -> Detector {
        let pixels = camera.width_px as usize * camera.height_px as usize;
        Detector {
            config: *config,
            seed,
            stream_name: format!("sensor {number}"),
            vignetting: Vignetting::new(camera, &config.vignetting),
            point_spread: PointSpread::new(config.psf_sigma_px, config.defocus_radius_px),
            fixed_pattern: FixedPattern::new(config, pixels, &mut random_stream(seed, "sensor pattern", number)),
            read_out: ReadOut::new(config),
        }
    }

    /// The image as the detector delivers it. The same frame, detector and time give the same numbers.
    ///
    /// # Panics
    /// If the frame is not of the camera's size.
    pub fn expose(&self, frame: &RenderedFrame, t_ns: i64) -> GreyRaster {
        let width = frame.width_px as usize;
        let irradiance = self.vignetting.applied(&frame.radiance);
        let gain = electrons_per_irradiance(&irradiance, &frame.mask, &self.config);
        let spread = self.point_spread.applied(irradiance, width);
        let stream = random_stream(self.seed, &self.stream_name, t_ns as u64);
        let mut numbers = vec![0; spread.len()];
        numbers.par_chunks_mut(width).zip(spread.par_chunks(width)).enumerate().for_each(|(row, (numbers, light))| {
            let light_electrons: Vec<f32> = light.iter().map(|irradiance| irradiance * gain).collect();
            self.read_row(row * width, &light_electrons, numbers, &mut sub_stream(&stream, row as u64));
        });
        GreyRaster { width_px: frame.width_px, height_px: frame.height_px, bits: self.config.bits, numbers }
    }

    /// Numbers of one row whose first pixel has the index `first`, from the electrons that light is expected to free.
    fn read_row(&self, first: usize, light_electrons: &[f32], numbers: &mut [u16], random: &mut impl Rng) {
        for (column, (number, light)) in numbers.iter_mut().zip(light_electrons).enumerate() {
            let pixel = self.fixed_pattern.pixel(first + column);
            let expected = f64::from((light * pixel.response).max(0.0) + pixel.dark_electrons);
            let freed = if self.config.noise { shot(expected, random) } else { expected };
            let held = self.read_out.held(freed + f64::from(pixel.offset_electrons));
            *number = if self.config.noise { self.read_out.noisy(held, random) } else { self.read_out.number(held) };
        }
    }
}
