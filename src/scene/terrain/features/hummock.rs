//! Hummocks: low rounded knobs that crowd in patches of rough ground and leave the plains between them smooth.

use super::bins::Bounded;
use super::scatter::{Feature, Scatter};
use super::site_taper::at_most;
use super::softened::Spreadable;
use crate::scene::terrain::relief::FeatureSample;
use nalgebra::Vector2;

/// Hummocks of one octave of diameters.
#[derive(Debug, Clone, PartialEq)]
pub struct HummockClass {
    /// Where they are.
    pub scatter: Scatter,
    /// Height of the highest over its diameter.
    pub height_ratio: f64,
    /// No hummock is higher than this times its distance from the origin.
    pub site_slope: f64,
    /// Largest relative change of the albedo.
    pub albedo_contrast: f64,
}

impl HummockClass {
    /// One hummock, ready to be added to places.
    pub(in crate::scene) fn hummock(&self, feature: &Feature) -> Hummock {
        let [turn, slimness, tint, stature] = feature.random;
        let (sin, cos) = (turn * std::f64::consts::TAU).sin_cos();
        let natural_m = feature.diameter_m * self.height_ratio * (0.3 + 0.7 * stature);
        Hummock {
            center_m: feature.center_m,
            per_radius_1_m: 2.0 / feature.diameter_m,
            crest: Vector2::new(cos, sin) * (0.6 * slimness),
            height_m: at_most(natural_m, self.site_slope * feature.center_m.norm()),
            albedo: self.albedo_contrast * (tint - 0.5),
        }
    }
}

/// One hummock.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hummock {
    center_m: Vector2<f64>,
    per_radius_1_m: f64,
    /// Slope of the top over the height a radius.
    crest: Vector2<f64>,
    height_m: f64,
    albedo: f64,
}

impl Bounded for Hummock {
    fn circle_m(&self) -> (Vector2<f64>, f64) {
        (self.center_m, 1.0 / self.per_radius_1_m)
    }
}

impl Spreadable for Hummock {
    fn radius_m(&self) -> f64 {
        1.0 / self.per_radius_1_m
    }

    fn spread(&self, growth: f64, strength: f64) -> Self {
        Hummock {
            per_radius_1_m: self.per_radius_1_m / growth,
            height_m: self.height_m * strength,
            albedo: self.albedo * strength,
            ..*self
        }
    }

    /// (1 - t²)² of the height at `t` radii, times a tilted plane.
    fn add_to(&self, total: &mut FeatureSample, at: &Vector2<f64>) {
        let from_center = (at - self.center_m) * self.per_radius_1_m;
        let inside = 1.0 - from_center.norm_squared();
        if inside <= 0.0 {
            return;
        }
        let dome = inside * inside;
        let top = 1.0 + self.crest.dot(&from_center);
        total.height_m += self.height_m * dome * top;
        let by_radius = self.crest * dome - from_center * (4.0 * inside * top);
        total.gradient += by_radius * (self.height_m * self.per_radius_1_m);
        total.albedo += self.albedo * dome;
    }
}
