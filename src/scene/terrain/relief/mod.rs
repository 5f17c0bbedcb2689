//! Heights and slopes of the ground as sums of octaves and features.

mod ground_sample;
mod octave_sums;

pub use ground_sample::{FeatureSample, GroundDetail, GroundSample};
pub use octave_sums::{OctaveSource, OctaveSums};
