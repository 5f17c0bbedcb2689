//! Tests of the room `navigation`.

mod filter;
#[cfg(feature = "scene")]
mod landing;
mod landmark;
mod observability;
mod tumbling;
