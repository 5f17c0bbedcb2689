//! The image front end.

pub mod accuracy;
mod config;
mod features;
#[cfg(feature = "render")]
mod map;
mod masks;
mod matching;
mod noise_model;
mod pair;
pub mod texture;
mod tracking;
