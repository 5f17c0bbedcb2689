//! The image front end.

mod bearings;
mod features;
mod files;
mod rotation;
mod sequences;
mod texture;
mod tumbling;
