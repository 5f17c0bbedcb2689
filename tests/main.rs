//! One test binary, so that it links once: a module a room, and in it a module a wing, as in `src`.

mod accuracy_bar;
mod architecture;
#[cfg(all(feature = "render", feature = "vision"))]
mod calibration;
mod campaign;
#[cfg(all(feature = "render", feature = "vision"))]
mod cli;
mod dataset;
mod evaluation;
mod fuzz;
mod geometry;
mod navigation;
mod observations;
#[cfg(all(feature = "render", feature = "vision"))]
mod pipeline;
#[cfg(feature = "render")]
mod render;
mod report;
mod scene;
#[cfg(all(feature = "render", feature = "vision"))]
mod settings;
mod stats;
#[cfg(feature = "vision")]
mod vision;
