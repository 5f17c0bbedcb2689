//! Parameters of rendering.

use super::RenderError;
use serde::{Deserialize, Serialize};

/// Parameters of rendering.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct RenderConfig {
    /// Samples a pixel and axis (default 2, which is four samples a pixel).
    pub supersampling: u32,
    /// Edge of the shadow map in texels (default 2048).
    pub shadow_map_px: u32,
    /// Largest spacing of terrain vertices in px, seen face on (default 1.5).
    pub vertex_spacing_px: f64,
}

impl Default for RenderConfig {
    fn default() -> Self {
        RenderConfig { supersampling: 2, shadow_map_px: 2048, vertex_spacing_px: 1.5 }
    }
}

impl RenderConfig {
    /// Checks every parameter's range.
    ///
    /// # Errors
    /// [`RenderError::Config`] names the key.
    pub fn validate(&self) -> Result<(), RenderError> {
        let ranges = [
            ("supersampling", f64::from(self.supersampling), 1.0, 8.0, "1 to 8"),
            ("shadow_map_px", f64::from(self.shadow_map_px), 64.0, 8192.0, "64 to 8192"),
            ("vertex_spacing_px", self.vertex_spacing_px, 0.25, 16.0, "0.25 to 16 px"),
        ];
        for (key, value, low, high, range) in ranges {
            if !(low..=high).contains(&value) {
                return Err(RenderError::Config { key, value, range });
            }
        }
        Ok(())
    }
}
