//! The image front end.

mod bearings;
mod features;
mod files;
mod gaps;
mod rotation;
mod sequences;
mod texture;
mod tumbling;
