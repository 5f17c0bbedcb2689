//! The designated point: carried from image to image, found again from keyframes, and how far it drifts.

mod carry;
mod drift;
mod keyframes;

pub use carry::carry_designated;
pub use drift::drift_per_image_px;
