//! The designated point: carried from picture to picture, found again from keyframes, and how far it drifts.

mod carry;
mod keyframes;

pub use carry::carry_designated;
