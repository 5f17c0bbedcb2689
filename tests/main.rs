//! One test binary, so that it links once: a module a room, and in it a module a wing, as in `src`.

#[cfg(any(feature = "scene", feature = "vision"))]
mod accuracy_bar;
mod architecture;
#[cfg(all(feature = "render", feature = "vision"))]
mod calibration;
#[cfg(feature = "scene")]
mod campaign;
#[cfg(all(feature = "cli", feature = "render", feature = "report", feature = "vision"))]
mod cli;
#[cfg(all(feature = "cli", not(feature = "vision")))]
mod cli_left_out;
mod dataset;
mod evaluation;
mod fuzz;
mod geometry;
mod navigation;
mod observations;
#[cfg(all(feature = "render", feature = "vision"))]
mod pipeline;
mod reference_body;
#[cfg(feature = "render")]
mod render;
#[cfg(feature = "report")]
mod report;
#[cfg(feature = "scene")]
mod scene;
#[cfg(all(feature = "report", feature = "scene", feature = "vision"))]
mod settings;
mod stats;
#[cfg(feature = "vision")]
mod vision;
