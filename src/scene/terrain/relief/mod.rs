//! Heights and slopes of the ground as sums of octaves (`octave_sums`), and what a place of the ground is asked for and
//! gives (`ground_sample`). It knows neither features nor files.

mod ground_sample;
mod octave_sums;

pub use ground_sample::{FeatureSample, GroundDetail, GroundSample};
pub use octave_sums::{OctaveSource, OctaveSums};
