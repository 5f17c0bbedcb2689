//! Rocks: blocks with steep sides that stand in the ground, numbered by Golombek's law.

use super::FeatureSample;
use super::terrain_bins::Bounded;
use super::terrain_scatter::{Feature, Scatter};
use super::terrain_site::at_most;
use super::terrain_softened::Spreadable;
use nalgebra::{Rotation2, Vector2};

/// Rocks of one octave of diameters.
#[derive(Debug, Clone, PartialEq)]
pub struct RockClass {
    /// Where they are.
    pub scatter: Scatter,
    /// No rock is higher than this times its distance from the origin.
    pub site_slope: f64,
    /// Largest relative change of the albedo.
    pub albedo_contrast: f64,
}

/// Rocks a square metre between the diameters D and D + dD, times D/dD, for a total `abundance` k (the share of the
/// ground that rocks cover): the cumulative share by rocks of at least D is F(D) = k exp(-q D) with q = 1.79 + 0.152/k
/// (Golombek and Rapp, "Size-frequency distributions of rocks on Mars and Earth analog sites", J. Geophys. Res. 102(E2),
/// 1997), each rock covering π D²/4.
pub fn rock_density_1_m2(abundance: f64, diameter_m: f64) -> f64 {
    let q_1_m = 1.79 + 0.152 / abundance;
    let share_by_diameter = abundance * q_1_m * (-q_1_m * diameter_m).exp();
    4.0 * share_by_diameter / (std::f64::consts::PI * diameter_m)
}

/// Height of a rock over its radius: this and up to as much again, so that a mean rock is half buried.
const HEIGHT_RATIO: f64 = 0.6;
/// Width of the slimmest rock over its length.
const SLIMMEST: f64 = 0.6;
/// Largest tilt of a rock's top: change of its height over the height, centre to edge.
const MOST_TILT: f64 = 0.35;
/// Area of the outline of [`Rock::add_to`] over that of the ellipse with the same axes.
const OUTLINE_AREA: f64 = 1.0732;

impl RockClass {
    /// Adds what one rock does to a place (m).
    pub fn add(&self, feature: &Feature, total: &mut FeatureSample, x_m: f64, y_m: f64) {
        self.rock(feature).add_to(total, &Vector2::new(x_m, y_m));
    }

    /// One rock, ready to be added to places.
    pub(super) fn rock(&self, feature: &Feature) -> Rock {
        let [turn, slimness, tint, stature] = feature.random;
        let rock_from_site = Rotation2::new(turn * std::f64::consts::TAU);
        let stretch = (SLIMMEST + (1.0 - SLIMMEST) * slimness).sqrt();
        let radius_m = 0.5 * feature.diameter_m / OUTLINE_AREA.sqrt();
        let natural_m = radius_m * HEIGHT_RATIO * (1.0 + stature);
        let scale = Vector2::new(stretch, 1.0 / stretch) / radius_m;
        Rock {
            center_m: feature.center_m,
            reach_squared_m2: (1.08 * radius_m / stretch).powi(2),
            unit_from_site: nalgebra::Matrix2::from_diagonal(&scale) * rock_from_site.matrix(),
            height_m: at_most(natural_m, self.site_slope * feature.center_m.norm()),
            tilt: MOST_TILT * (2.0 * tint - 1.0),
            albedo: self.albedo_contrast * (tint - 0.6),
        }
    }
}

/// One rock.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rock {
    center_m: Vector2<f64>,
    reach_squared_m2: f64,
    /// From offsets in m to the outline's own axes, in which it reaches 1 along both.
    unit_from_site: nalgebra::Matrix2<f64>,
    height_m: f64,
    tilt: f64,
    albedo: f64,
}

impl Bounded for Rock {
    fn circle_m(&self) -> (Vector2<f64>, f64) {
        (self.center_m, self.reach_squared_m2.sqrt())
    }
}

impl Spreadable for Rock {
    fn radius_m(&self) -> f64 {
        self.reach_squared_m2.sqrt()
    }

    fn spread(&self, growth: f64, strength: f64) -> Self {
        Rock {
            reach_squared_m2: self.reach_squared_m2 * growth * growth,
            unit_from_site: self.unit_from_site / growth,
            height_m: self.height_m * strength,
            albedo: self.albedo * strength,
            ..*self
        }
    }

    /// With (x, y) in the outline's axes, the outline is 1 = x⁴ + y⁴ + x²y², a rounded square; heights fall as 1 minus
    /// that, times a tilted plane.
    fn add_to(&self, total: &mut FeatureSample, at: &Vector2<f64>) {
        let from_center = at - self.center_m;
        if from_center.norm_squared() >= self.reach_squared_m2 {
            return;
        }
        let at = self.unit_from_site * from_center;
        let (xx, yy) = (at.x * at.x, at.y * at.y);
        let inside = 1.0 - xx * xx - yy * yy - xx * yy;
        if inside <= 0.0 {
            return;
        }
        let top = self.height_m * (1.0 + self.tilt * at.x);
        total.height_m += top * inside;
        let by_at = Vector2::new(
            -top * at.x * (4.0 * xx + 2.0 * yy) + self.height_m * self.tilt * inside,
            -top * at.y * (4.0 * yy + 2.0 * xx),
        );
        total.gradient += self.unit_from_site.tr_mul(&by_at);
        total.albedo += self.albedo;
    }
}
