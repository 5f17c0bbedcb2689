//! One test binary with a module a room, so that it links once.

mod architecture;
mod dataset;
mod evaluation;
mod filter;
mod geometry;
mod landing;
mod landmark;
mod observability;
#[cfg(feature = "render")]
mod render;
mod report;
mod scene;
mod stats;
mod terrain;
mod tumbling;
#[cfg(feature = "vision")]
mod vision;
