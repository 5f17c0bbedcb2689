//! Tests of the room `evaluation`.

mod bench;
mod consistency;
mod landing;
mod metrics;
mod pairs;
#[cfg(feature = "scene")]
mod picture;
mod refusals;
mod tracks;
mod tumbling;
