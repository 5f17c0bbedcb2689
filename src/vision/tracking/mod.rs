//! From pairs to tracks. `image_features` describes a image, `adjacent_pair` solves it with the one before,
//! `refined_match` places matches by intensities, `image_chain` runs along the sequence holding only what is needed,
//! `tracks` joins the links and `coasted_tracks` finds lost ones again; `keyframe_pairs` and `ambiguous_pairs` come
//! after, `output_order` last. `sequence.rs`, above, is the recipe.

mod adjacent_pair;
mod ambiguous_pairs;
mod coasted_tracks;
mod context;
mod image_chain;
mod image_features;
mod keyframe_pairs;
mod link;
mod output_order;
mod pair_pixels;
mod refined_match;
mod tracks;

pub use ambiguous_pairs::resolve_ambiguous_pairs;
pub use context::{Center, TrackingContext, milliseconds};
pub use image_chain::{Chain, link};
pub use keyframe_pairs::keyframe_rotations;
pub use output_order::rotations_in_order;
pub use tracks::Tracks;
