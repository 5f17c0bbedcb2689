//! One test binary with a module a room, so that it links once.

mod architecture;
mod bar;
#[cfg(all(feature = "render", feature = "vision"))]
mod cli;
mod dataset;
#[cfg(all(feature = "render", feature = "vision"))]
mod end_to_end;
mod evaluation;
mod filter;
mod fuzz;
mod geometry;
mod landing;
mod landmark;
#[cfg(all(feature = "render", feature = "vision"))]
mod map_matching;
mod observability;
#[cfg(feature = "render")]
mod render;
#[cfg(all(feature = "render", feature = "vision"))]
mod rendered_landings;
#[cfg(all(feature = "render", feature = "vision"))]
mod rendered_sequences;
mod report;
mod scene;
mod stats;
#[cfg(all(feature = "render", feature = "vision"))]
mod synthesis;
mod terrain;
mod tumbling;
#[cfg(feature = "vision")]
mod vision;
