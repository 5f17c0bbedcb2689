//! The designated point: carried from picture to picture, found again from keyframes, and how far it drifts.

mod carry;
mod drift;
mod keyframes;

pub use carry::carry_designated;
pub use drift::drift_a_picture_px;
