//! The detector: from the radiance of an image to digital numbers.
//!
//! One file a stage, in physical order, after the linear camera model of EMVA 1288 (release 4.0): irradiance with
//! vignetting, point spread, exposure to electrons, shot noise of light and dark current with the fixed pattern, full
//! well, read noise, gain, black level and quantisation. [`Detector`] runs the chain; every row of an image has a random
//! stream of its own, so the same scenario and seed give the same bytes on any number of threads.

mod detector;
mod exposure_level;
mod fixed_pattern;
mod point_spread;
mod read_out;
mod shot_noise;
mod vignetting;

pub use detector::Detector;
