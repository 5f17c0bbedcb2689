//! The image front end.

#[cfg(feature = "render")]
mod bars;
mod bearings;
mod center_table;
mod descriptors;
mod features;
mod files;
mod gaps;
#[cfg(feature = "render")]
pub mod known_center;
mod landing_camera;
mod likelihood;
mod lost_tracks;
mod masks;
#[cfg(feature = "render")]
mod rendered;
mod rotation;
mod rotation_table;
mod sequences;
pub mod texture;
mod tumbling;
