//! Heights and slopes of the ground as sums of octaves and features.

mod octave_sums;

pub use octave_sums::OctaveSums;
