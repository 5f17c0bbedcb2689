//! The detector: exposure, point-spread function, shot and read noise, quantisation.

use super::RenderedFrame;
use crate::scene::{Exposure, SensorConfig};
use crate::stats::random_stream;
use image::{GrayImage, ImageBuffer, Luma};
use imageproc::filter::gaussian_blur_f32;
use rand_distr::{Distribution, Normal, Poisson};

/// Share of the full well at which automatic exposure puts the bright end of the picture.
const AUTO_EXPOSURE_SHARE: f64 = 0.8;
/// Part of the lit pixels that automatic exposure keeps below that share.
const AUTO_EXPOSURE_PERCENTILE: f64 = 0.99;
/// Largest mean for which shot noise is drawn from the Poisson distribution itself.
const LARGEST_POISSON_MEAN: f64 = 50.0;

/// The picture as the detector delivers it, 8 bits a pixel. The same frame, configuration, seed and time give the same
/// bytes.
pub fn expose(frame: &RenderedFrame, sensor: &SensorConfig, seed: u64, t_ns: i64) -> GrayImage {
    let gain = electrons_per_radiance(frame, sensor);
    let radiance: ImageBuffer<Luma<f32>, Vec<f32>> =
        ImageBuffer::from_raw(frame.width_px, frame.height_px, frame.radiance.clone())
            .expect("a frame holds width times height pixels");
    let blurred =
        if sensor.psf_sigma_px > 0.0 { gaussian_blur_f32(&radiance, sensor.psf_sigma_px as f32) } else { radiance };
    let mut random = random_stream(seed, "sensor", t_ns as u64);
    let read_noise = Normal::new(0.0, sensor.read_noise_electrons.max(0.0)).expect("a finite standard deviation");
    let levels = 2.0_f64.powi(sensor.bits.clamp(1, 8) as i32) - 1.0;
    let to_byte = 255.0 / levels;
    let bytes = blurred.pixels().map(|pixel| {
        let mean = (f64::from(pixel[0]) * gain).max(0.0);
        let electrons = if sensor.noise { shot(mean, &mut random) + read_noise.sample(&mut random) } else { mean };
        let number = (electrons / sensor.full_well_electrons * levels).round().clamp(0.0, levels);
        (number * to_byte).round() as u8
    });
    GrayImage::from_raw(frame.width_px, frame.height_px, bytes.collect()).expect("one byte a pixel")
}

fn shot(mean: f64, random: &mut impl rand::Rng) -> f64 {
    if mean <= 0.0 {
        return 0.0;
    }
    if mean > LARGEST_POISSON_MEAN {
        return Normal::new(mean, mean.sqrt()).expect("a finite mean").sample(random);
    }
    Poisson::new(mean).expect("a positive mean").sample(random)
}

/// Electrons that a radiance (I/F) of 1 gives.
fn electrons_per_radiance(frame: &RenderedFrame, sensor: &SensorConfig) -> f64 {
    match sensor.exposure {
        Exposure::Fixed { electrons_per_radiance } => electrons_per_radiance,
        Exposure::Auto => {
            let bright = f64::from(bright_end(frame));
            if bright > 0.0 { AUTO_EXPOSURE_SHARE * sensor.full_well_electrons / bright } else { 0.0 }
        }
    }
}

/// The 99th percentile of the radiance of lit pixels; 0 if none is lit.
fn bright_end(frame: &RenderedFrame) -> f32 {
    let lit = frame.radiance.iter().zip(&frame.mask).filter(|(_, m)| *m & RenderedFrame::LIT != 0);
    let mut lit: Vec<f32> = lit.map(|(r, _)| *r).collect();
    if lit.is_empty() {
        return 0.0;
    }
    let index = ((lit.len() - 1) as f64 * AUTO_EXPOSURE_PERCENTILE) as usize;
    *lit.select_nth_unstable_by(index, f32::total_cmp).1
}
