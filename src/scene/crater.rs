//! Impact craters, from fresh to degraded: a bowl inside a rim, and ejecta of another albedo.

use super::terrain_scatter::{Feature, Scatter};
use nalgebra::Vector2;

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

/// Craters of one octave of diameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CraterClass {
    /// Where they are.
    pub scatter: Scatter,
    /// Depth of a fresh crater over its diameter.
    pub depth_ratio: f64,
    /// No crater is deeper than this times its distance from the origin.
    pub site_slope: f64,
    /// Relative change of the albedo by the freshest craters' ejecta.
    pub albedo_contrast: f64,
}

/// Craters grow shallower for their diameter beyond this diameter in m.
const SHALLOWING_M: f64 = 300.0;

impl CraterClass {
    /// Adds what one crater does to a place (m).
    pub fn add(&self, feature: &Feature, total: &mut FeatureSample, x_m: f64, y_m: f64) {
        let from_center = Vector2::new(x_m, y_m) - feature.center_m;
        let t_squared = 4.0 * from_center.norm_squared() / feature.diameter_m.powi(2);
        if t_squared < Scatter::REACH_RADII.powi(2) {
            self.crater(feature).add_to(total, &from_center, t_squared.sqrt());
        }
    }

    fn crater(&self, feature: &Feature) -> Crater {
        let [age, tint, ..] = feature.random;
        let freshness = age * age;
        let natural_m = feature.diameter_m * self.depth_ratio * (0.15 + 0.85 * freshness)
            / (1.0 + feature.diameter_m / SHALLOWING_M);
        Crater {
            radius_m: 0.5 * feature.diameter_m,
            depth_m: at_most(natural_m, self.site_slope * feature.center_m.norm()),
            freshness,
            albedo: self.albedo_contrast * (2.0 * tint - 1.0) * (0.2 + 0.8 * freshness),
        }
    }
}

/// A smooth minimum of two positive numbers.
pub(super) fn at_most(natural: f64, allowed: f64) -> f64 {
    natural * allowed / (natural.powi(2) + allowed.powi(2)).sqrt().max(1e-12)
}

struct Crater {
    radius_m: f64,
    depth_m: f64,
    freshness: f64,
    albedo: f64,
}

impl Crater {
    fn add_to(&self, total: &mut FeatureSample, from_center: &Vector2<f64>, t: f64) {
        let (height_m, slope) = self.profile(t);
        let taper = 1.0 - (t / Scatter::REACH_RADII).powi(2);
        total.height_m += height_m;
        if t > 0.0 {
            total.gradient += from_center * (slope / (self.radius_m.powi(2) * t));
        }
        total.albedo += self.albedo * taper * taper;
    }

    /// Height at `t` radii from the centre, and its derivative by `t`. Rims widen as craters degrade.
    fn profile(&self, t: f64) -> (f64, f64) {
        let rim_m = self.depth_m * 0.25 * (0.4 + 0.6 * self.freshness);
        let width = 0.32 - 0.17 * self.freshness;
        let offset = (t - 1.0) / width;
        let rim = rim_m * (-offset * offset).exp();
        let (mut height, mut slope) = (rim, -2.0 * offset / width * rim);
        if t < 1.0 {
            let inside = 1.0 - t * t;
            height -= self.depth_m * inside * inside;
            slope += self.depth_m * 4.0 * t * inside;
        }
        (height, slope)
    }
}
