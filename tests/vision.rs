//! The image front end.

mod bearings;
mod rotation;
mod tumbling;
