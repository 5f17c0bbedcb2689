//! Light on what is seen. `job` says what a image needs, `shadow` draws the Sun's view of the surface, `photometry` and
//! `noise` lay laws and detail finer than the mesh out for their shaders (each with a twin test against the CPU's
//! formulas), `shading_pipelines` compiles, `shading` records the pass. It shades bodies and terrain alike.

mod job;
mod noise;
mod photometry;
mod shading;
mod shading_pipelines;
mod shadow;

pub use job::{ShadingJob, ShadingKind};
pub use noise::octave_table;
pub use photometry::{photometry_data, photometry_model};
pub use shading::ShadingPass;
pub use shadow::{ShadowBox, ShadowMap, shadow_axes, texture_from_clip};

#[cfg(test)]
pub use shading_pipelines::SOURCE;
