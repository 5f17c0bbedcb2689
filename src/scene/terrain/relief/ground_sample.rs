//! Height, slope and albedo of the ground at one place.

use nalgebra::Vector2;

/// The ground at one place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GroundSample {
    /// Height in m.
    pub height_m: f64,
    /// Gradient of the height by x and y.
    pub gradient: Vector2<f64>,
    /// Albedo over the mean albedo, minus 1, before clamping.
    pub albedo_change: f64,
}

/// Which details of the ground are evaluated: those at least this large, in m.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct GroundDetail {
    /// Wavelength of relief that counts in the height.
    pub height_m: f64,
    /// Wavelength of relief and albedo that counts in gradient and albedo; at least `height_m`.
    pub shade_m: f64,
    /// Diameter that features need to be shown whole; round ones show from half of it, ripples and units from more.
    pub feature_m: f64,
    /// Diameter of the smallest rock that shows.
    pub rock_m: f64,
    /// Footprint of a pixel: details near it fade as they do in an image. 0 shows all.
    pub footprint_m: f64,
}

impl GroundSample {
    /// The ground with what stands on it; nothing changes where that has no height.
    pub(in crate::scene) fn under(self, standing: &FeatureSample) -> GroundSample {
        GroundSample {
            height_m: self.height_m + standing.height_m,
            gradient: self.gradient + standing.gradient,
            albedo_change: self.albedo_change + standing.albedo,
        }
    }
}

/// Height, gradient and relative albedo that features add at a place.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FeatureSample {
    /// Height in m.
    pub height_m: f64,
    /// Gradient of the height.
    pub gradient: Vector2<f64>,
    /// Relative change of the albedo.
    pub albedo: f64,
}
