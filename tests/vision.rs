//! The image front end.

mod bearings;
mod features;
mod files;
mod gaps;
mod landing_camera;
mod rotation;
mod sequences;
pub mod texture;
mod tumbling;
