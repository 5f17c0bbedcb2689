//! Patches: aligned to a fraction of a pixel, followed from image to image, warped as the surface turns.

mod affine_alignment;
mod alignment;
mod config;
mod local_affine;
mod patch_tracker;
mod sampling;

pub use affine_alignment::refine_with_stretch;
pub use alignment::refine_by_patch;
pub use config::KltConfig;
pub use local_affine::{Affine, Match, fit_affine};
pub use patch_tracker::{KltPoint, track_patches};
