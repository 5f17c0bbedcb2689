//! Tests of the room `navigation`.

mod filter;
mod landing;
mod landmark;
mod observability;
mod tumbling;
