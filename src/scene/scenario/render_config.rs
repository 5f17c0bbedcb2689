//! How finely images are drawn.

use crate::settings::{OutOfRange, limits};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How finely images are drawn: the table `[render]`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RenderConfig {
    /// Samples a pixel and axis, 1 to 8 (default 2, which is four samples a pixel).
    pub supersampling: u32,
    /// Edge of the shadow map in texels, 64 to 8192 (default 2048).
    pub shadow_map_px: u32,
    /// Least spacing of terrain vertices in px, seen face on, 0.25 to 16 (default 0.8); the largest is twice that.
    pub vertex_spacing_px: f64,
    /// Whether the normal and the albedo of every pixel are read back too (default false). No key of `[render]`: it follows
    /// from `[truth]`.
    #[serde(skip)]
    pub surface_truth: bool,
}

impl Default for RenderConfig {
    fn default() -> Self {
        RenderConfig { supersampling: 2, shadow_map_px: 2048, vertex_spacing_px: 0.8, surface_truth: false }
    }
}

impl RenderConfig {
    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::count("supersampling", self.supersampling as usize, 1, 8)?;
        limits::count("shadow_map_px", self.shadow_map_px as usize, 64, 8192)?;
        limits::within("vertex_spacing_px", self.vertex_spacing_px, 0.25, 16.0)
    }
}
