//! A small body: its shape and how its surface looks.

use super::mesh::{AlbedoMapFile, Mesh};
use crate::scene::photometry::Photometry;
use crate::settings::{OutOfRange, limits};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How a small body's surface looks below the resolution of its mesh.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BodySurface {
    /// Seed of the detail.
    pub seed: u64,
    /// Mean albedo, 0 to 1.
    pub albedo: f64,
    /// How the surface scatters sunlight.
    pub photometry: Photometry,
    /// Relative r.m.s. variation of the albedo, per octave of detail.
    pub albedo_contrast: f64,
    /// Largest wavelength of the detail in m.
    pub detail_wavelength_m: f64,
    /// R.m.s. slope of the bump detail, rise over run.
    pub detail_slope: f64,
}

impl Default for BodySurface {
    fn default() -> Self {
        BodySurface {
            seed: 1,
            albedo: 0.12,
            photometry: Photometry::default(),
            albedo_contrast: 0.06,
            detail_wavelength_m: 60.0,
            detail_slope: 0.25,
        }
    }
}

/// The surface of any body, whatever its size: the largest wavelength of the detail follows from the mesh.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SurfaceConfig {
    /// Mean albedo, 0 to 1 (default 0.12).
    pub albedo: f64,
    /// Map of the albedo over the body, instead of what the shape file carries; its mean becomes `albedo` (default none).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub albedo_map: Option<AlbedoMapFile>,
    /// Whether there is detail below the mesh's resolution, in slopes and albedo (default true).
    pub detail: bool,
    /// Relative r.m.s. variation of the albedo, per octave of detail, 0 to 1 (default 0.06).
    pub albedo_contrast: f64,
    /// Largest wavelength of the detail, in mean edges of the mesh, 0.01 to 1000 (default 12).
    pub detail_wavelength_edges: f64,
    /// R.m.s. slope of the bump detail, rise over run, 0 to 2 (default 0.25).
    pub detail_slope: f64,
    /// How the surface scatters sunlight (default lunar-Lambert with weight 0.6).
    pub photometry: Photometry,
}

impl Default for SurfaceConfig {
    fn default() -> Self {
        let surface = BodySurface::default();
        SurfaceConfig {
            albedo: surface.albedo,
            albedo_map: None,
            detail: true,
            albedo_contrast: surface.albedo_contrast,
            detail_wavelength_edges: 12.0,
            detail_slope: surface.detail_slope,
            photometry: surface.photometry,
        }
    }
}

impl SurfaceConfig {
    /// The surface of a body with this mesh.
    pub fn on(&self, mesh: &Mesh, seed: u64) -> BodySurface {
        let strength = if self.detail { 1.0 } else { 0.0 };
        BodySurface {
            seed,
            albedo: self.albedo,
            photometry: self.photometry,
            albedo_contrast: strength * self.albedo_contrast,
            detail_wavelength_m: strength * self.detail_wavelength_edges * mesh.mean_edge_m(),
            detail_slope: strength * self.detail_slope,
        }
    }

    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::within("albedo", self.albedo, 0.001, 1.0)?;
        if let Some(map) = &self.albedo_map {
            map.validate().map_err(|e| e.under("albedo_map"))?;
        }
        limits::within("albedo_contrast", self.albedo_contrast, 0.0, 1.0)?;
        limits::within("detail_wavelength_edges", self.detail_wavelength_edges, 0.01, 1000.0)?;
        limits::within("detail_slope", self.detail_slope, 0.0, 2.0)?;
        self.photometry.validate(self.albedo)
    }
}

/// A small body in asteroid axes, its centre of mass at the origin.
#[derive(Debug, Clone, PartialEq)]
pub struct SmallBody {
    /// Shape in the asteroid frame, m.
    pub mesh: Mesh,
    /// Surface detail.
    pub surface: BodySurface,
}
