//! Patches: placed by intensities to a hundredth of a pixel (`alignment`; `affine_alignment` where they also stretch),
//! followed through images (`patch_tracker`), and warped as the matches about them say (`local_affine`); `sampling` is
//! the hot loop under all of them. Tracks, the designated point and maps use it.

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
