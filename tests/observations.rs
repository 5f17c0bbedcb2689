//! Tests of the room `observations`.

#[cfg(feature = "vision")]
mod files;
