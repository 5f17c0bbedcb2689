//! Impact craters of all ages: sharp bowls with raised rims and ejecta when fresh, shallow dishes with a flat floor when
//! old.
//!
//! Fresh simple craters: depth from rim to floor about 0.2 of the diameter, rim about 0.04 of it above the ground, ejecta
//! that thin with the third power of the distance (Melosh, "Impact Cratering", 1989, chapters 5 and 6). Old ones are
//! softened as by the creep of their slopes, and partly filled.

use super::bins::Bounded;
use super::scatter::{Feature, Scatter};
use super::site_taper::at_most;
use super::softened::Spreadable;
use crate::scene::terrain::relief::FeatureSample;
use nalgebra::Vector2;

/// Craters of one octave of diameters.
#[derive(Debug, Clone, PartialEq)]
pub struct CraterClass {
    /// Where they are.
    pub scatter: Scatter,
    /// Depth of a fresh crater over its diameter.
    pub depth_ratio: f64,
    /// No crater is deeper than this times its distance from the origin.
    pub site_slope: f64,
    /// Largest relative change of the albedo by fresh ejecta and by floors.
    pub albedo_contrast: f64,
}

/// Craters grow shallower for their diameter beyond this diameter in m.
const SHALLOWING_M: f64 = 600.0;
/// Depth of the oldest craters over that of fresh ones.
const OLDEST_DEPTH: f64 = 0.12;
/// Height of a fresh rim over the depth of the floor below the rim.
const RIM_SHARE: f64 = 0.2;
/// Largest half-width over which the slope turns at the rim, in radii.
const MOST_ROUNDING: f64 = 0.4;
/// Half-width of an old crater's rim, in radii.
const OLD_RIM_WIDTH: f64 = 0.6;

impl CraterClass {
    /// Adds what one crater does to a place (m).
    pub fn add(&self, feature: &Feature, total: &mut FeatureSample, x_m: f64, y_m: f64) {
        self.crater(feature).add_to(total, &Vector2::new(x_m, y_m));
    }

    /// One crater, ready to be added to places.
    pub(in crate::scene) fn crater(&self, feature: &Feature) -> Crater {
        let [age, tint, floor_tint, _] = feature.random;
        let freshness = age * age * age;
        let natural_m = feature.diameter_m * self.depth_ratio * (OLDEST_DEPTH + (1.0 - OLDEST_DEPTH) * freshness)
            / (1.0 + feature.diameter_m / SHALLOWING_M);
        Crater {
            center_m: feature.center_m,
            per_radius_1_m: 2.0 / feature.diameter_m,
            reach_radii: Scatter::REACH_RADII,
            rounding_radii: 0.0,
            depth_m: at_most(natural_m, self.site_slope * feature.center_m.norm()),
            freshness,
            ejecta_albedo: self.albedo_contrast * (tint - 0.3) * freshness,
            floor_albedo: self.albedo_contrast * (0.15 - 0.6 * floor_tint),
        }
    }
}

/// One crater.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crater {
    center_m: Vector2<f64>,
    per_radius_1_m: f64,
    /// Where the ejecta end.
    reach_radii: f64,
    /// Half the width over which the slope turns at the rim.
    rounding_radii: f64,
    /// From rim to floor.
    depth_m: f64,
    /// 1 when new, 0 when old.
    freshness: f64,
    ejecta_albedo: f64,
    floor_albedo: f64,
}

impl Bounded for Crater {
    fn circle_m(&self) -> (Vector2<f64>, f64) {
        (self.center_m, self.reach_radii / self.per_radius_1_m)
    }
}

impl Spreadable for Crater {
    fn radius_m(&self) -> f64 {
        1.0 / self.per_radius_1_m
    }

    fn spread(&self, growth: f64, strength: f64) -> Self {
        Crater {
            per_radius_1_m: self.per_radius_1_m / growth,
            reach_radii: self.reach_radii / growth,
            rounding_radii: self.rounding_radii / growth,
            depth_m: self.depth_m * strength,
            ejecta_albedo: self.ejecta_albedo * strength,
            floor_albedo: self.floor_albedo * strength,
            ..*self
        }
    }

    fn rounded(&self, within_m: f64) -> Self {
        Crater { rounding_radii: (within_m * self.per_radius_1_m).min(MOST_ROUNDING), ..*self }
    }

    fn add_to(&self, total: &mut FeatureSample, at: &Vector2<f64>) {
        let from_center = at - self.center_m;
        let t_squared = from_center.norm_squared() * (self.per_radius_1_m * self.per_radius_1_m);
        if t_squared >= self.reach_radii * self.reach_radii {
            return;
        }
        let t = t_squared.sqrt();
        let (fresh, fresh_slope) = fresh_profile(t, self.reach_radii, self.rounding_radii);
        let (old, old_slope) = old_profile(t);
        let mix = |fresh: f64, old: f64| self.depth_m * (old + (fresh - old) * self.freshness);
        total.height_m += mix(fresh, old);
        if t > 0.0 {
            let per_m = mix(fresh_slope, old_slope) * self.per_radius_1_m * self.per_radius_1_m / t;
            total.gradient += from_center * per_m;
        }
        total.albedo += self.ejecta_albedo * ejecta_taper(t, self.reach_radii).0;
        if t < 1.0 {
            let inside = 1.0 - t_squared;
            total.albedo += self.floor_albedo * inside * inside;
        }
    }
}

/// Height of a fresh crater of depth 1 at `t` radii, and its derivative by `t`: a parabola up to the rim, then ejecta up
/// to `reach`. The derivative turns from the one to the other within `rounding` of the rim.
fn fresh_profile(t: f64, reach: f64, rounding: f64) -> (f64, f64) {
    let inside = || (RIM_SHARE - 1.0 + t * t, 2.0 * t);
    let outside = || {
        let (taper, taper_slope) = ejecta_taper(t, reach);
        let cubed = RIM_SHARE / (t * t * t);
        (cubed * taper, cubed * (taper_slope - 3.0 * taper / t))
    };
    if t <= 1.0 - rounding {
        return inside();
    }
    if t >= 1.0 + rounding {
        return outside();
    }
    let (inside, outside) = (inside(), outside());
    let s = 0.5 + 0.5 * (t - 1.0) / rounding;
    let share = s * s * (3.0 - 2.0 * s);
    (if t < 1.0 { inside.0 } else { outside.0 }, inside.1 + (outside.1 - inside.1) * share)
}

/// Height of an old crater of depth 1 at `t` radii, and its derivative: a flat floor, a wide low rim.
fn old_profile(t: f64) -> (f64, f64) {
    let offset = (t - 1.0) / OLD_RIM_WIDTH;
    let bump = (1.0 - offset * offset).max(0.0);
    let mut height = 0.4 * RIM_SHARE * bump * bump;
    let mut slope = -1.6 * RIM_SHARE * bump * offset / OLD_RIM_WIDTH;
    if t < 1.0 {
        let t_cubed = t * t * t;
        let inside = 1.0 - t_cubed * t;
        height -= (1.0 - RIM_SHARE) * inside * inside;
        slope += (1.0 - RIM_SHARE) * 8.0 * t_cubed * inside;
    }
    (height, slope)
}

/// From 1 at the rim to 0 at the reach, smooth at both ends; 1 inside the crater.
fn ejecta_taper(t: f64, reach: f64) -> (f64, f64) {
    let s = ((t - 1.0) / (reach - 1.0)).clamp(0.0, 1.0);
    let inside = 1.0 - s * s;
    (inside * inside, -4.0 * s * inside / (reach - 1.0))
}
