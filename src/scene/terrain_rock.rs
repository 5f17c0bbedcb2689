//! Rocks: oblong domes that rise steeply from the ground.

use super::FeatureSample;
use super::crater::at_most;
use super::terrain_scatter::{Feature, Scatter};
use nalgebra::{Rotation2, Vector2};

/// Rocks of one octave of lengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RockClass {
    /// Where they are.
    pub scatter: Scatter,
    /// No rock is higher than this times its distance from the origin.
    pub site_slope: f64,
    /// Largest relative change of the albedo.
    pub albedo_contrast: f64,
}

/// Height of a rock over its length: this and up to as much again.
const HEIGHT_RATIO: f64 = 0.15;
/// Width of the slimmest rock over its length.
const SLIMMEST: f64 = 0.6;

impl RockClass {
    /// Adds what one rock does to a place (m).
    pub fn add(&self, feature: &Feature, total: &mut FeatureSample, x_m: f64, y_m: f64) {
        let from_center = Vector2::new(x_m, y_m) - feature.center_m;
        if 4.0 * from_center.norm_squared() >= feature.diameter_m.powi(2) {
            return;
        }
        let [turn, slimness, tint, stature] = feature.random;
        let rock_from_site = Rotation2::new(turn * std::f64::consts::PI);
        let stretch = Vector2::new(1.0, 1.0 / (SLIMMEST + (1.0 - SLIMMEST) * slimness)) * (2.0 / feature.diameter_m);
        let at = (rock_from_site * from_center).component_mul(&stretch);
        let t_squared = at.norm_squared();
        if t_squared >= 1.0 {
            return;
        }
        let natural_m = feature.diameter_m * HEIGHT_RATIO * (1.0 + stature);
        let height_m = at_most(natural_m, self.site_slope * feature.center_m.norm());
        let inside = 1.0 - t_squared * t_squared;
        total.height_m += height_m * inside * inside;
        let by_at = at * (-8.0 * height_m * inside * t_squared);
        total.gradient += rock_from_site.inverse() * by_at.component_mul(&stretch);
        total.albedo += self.albedo_contrast * (tint - 0.7) * inside;
    }
}
