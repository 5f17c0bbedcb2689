//! A small body: its shape and how its surface looks.

use super::Mesh;
use serde::{Deserialize, Serialize};

/// How a small body's surface looks below the resolution of its mesh.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct BodySurface {
    /// Seed of the detail.
    pub seed: u64,
    /// Mean albedo, 0 to 1.
    pub albedo: f64,
    /// Relative r.m.s. variation of the albedo, per octave of detail.
    pub albedo_contrast: f64,
    /// Largest wavelength of the detail in m.
    pub detail_wavelength_m: f64,
    /// R.m.s. slope of the bump detail.
    pub detail_slope: f64,
}

impl Default for BodySurface {
    fn default() -> Self {
        BodySurface { seed: 1, albedo: 0.12, albedo_contrast: 0.06, detail_wavelength_m: 60.0, detail_slope: 0.25 }
    }
}

/// A small body in asteroid axes.
#[derive(Debug, Clone, PartialEq)]
pub struct SmallBody {
    /// Shape in the asteroid frame, m.
    pub mesh: Mesh,
    /// Surface detail.
    pub surface: BodySurface,
}
