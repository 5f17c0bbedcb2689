//! The image front end.

#[cfg(feature = "render")]
mod bars;
mod bearings;
mod features;
mod files;
mod gaps;
mod landing_camera;
#[cfg(feature = "render")]
mod rendered;
mod rotation;
mod sequences;
pub mod texture;
mod tumbling;
