//! Light on what is seen: shadows, photometry, detail finer than the mesh.

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
