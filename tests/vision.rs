//! The image front end.

pub mod accuracy;
mod features;
#[cfg(feature = "render")]
mod map;
mod masks;
mod matching;
mod pair;
pub mod texture;
mod tracking;
