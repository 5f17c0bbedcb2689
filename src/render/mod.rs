//! Images of terrain and small bodies with pixel-exact truth: the only room that names `wgpu`.
//!
//! An image takes three passes: a shadow map from the Sun, surface samples, several a pixel and one of them at its centre,
//! and one pass that shades each pixel by them with detail finer than the mesh. The truth is what the centre's sample
//! shows. A lens with distortion looks its samples up in a pinhole image. Each shader in `shaders/` has the name of the
//! file here that drives it. Positions reach the adapter relative to the camera,
//! subtracted in f64 or in two f32 steps that lose nothing.
//!
//! What a shutter collects over time is a mean of such images ([`Renderer::expose`]); a [`Detector`] makes digital
//! numbers of it, on the CPU.

mod body;
mod error;
mod exposure;
mod frame;
mod gpu;
mod optics;
mod orthoimage;
mod renderer;
mod sensor;
mod shading;
mod stars;
mod surface;
mod terrain;
mod world;

pub use crate::scene::RenderConfig;
pub use error::RenderError;
pub use frame::RenderedFrame;
pub use gpu::{AdapterReport, Gpu, StageTime, list_adapters};
pub use orthoimage::map_level;
pub use renderer::Renderer;
pub use sensor::Detector;
pub use stars::add_stars;
pub use world::World;
