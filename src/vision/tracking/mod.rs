//! From pairs to tracks: adjacent pairs, refined matches, chains, keyframe pairs, tracks that coast.

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
