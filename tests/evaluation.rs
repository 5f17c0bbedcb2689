//! Tests of the room `evaluation`.

mod bench;
mod consistency;
#[cfg(feature = "scene")]
mod image;
mod landing;
mod metrics;
mod pairs;
mod refusals;
mod tracks;
mod tumbling;
