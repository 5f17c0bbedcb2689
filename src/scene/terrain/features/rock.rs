//! Rocks: blocks with steep sides that stand in the ground, numbered by Golombek's law.

use super::bins::Bounded;
use super::scatter::{Feature, Scatter};
use super::site_taper::at_most;
use crate::scene::terrain::relief::FeatureSample;
use nalgebra::{Matrix2, Rotation2, Vector2};

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
/// Area of the outline of [`Rock::sample`] over that of the ellipse with the same axes.
const OUTLINE_AREA: f64 = 1.0732;
/// Distance of the outline's corners from the centre over the longer axis, or more.
const FARTHEST_CORNER: f64 = 1.08;

impl RockClass {
    /// Adds what one rock does to a place (m).
    pub fn add(&self, feature: &Feature, total: &mut FeatureSample, x_m: f64, y_m: f64) {
        let rock = self.rock(feature).sample(&Vector2::new(x_m, y_m));
        total.height_m += rock.height_m;
        total.gradient += rock.gradient;
        total.albedo += rock.albedo;
    }

    /// One rock, ready to be asked about places.
    pub(in crate::scene) fn rock(&self, feature: &Feature) -> Rock {
        let [turn, slimness, tint, stature] = feature.random;
        let rock_from_site = Rotation2::new(turn * std::f64::consts::TAU);
        let stretch = (SLIMMEST + (1.0 - SLIMMEST) * slimness).sqrt();
        let radius_m = 0.5 * feature.diameter_m / OUTLINE_AREA.sqrt();
        let natural_m = radius_m * HEIGHT_RATIO * (1.0 + stature);
        let axes_m = Vector2::new(1.0 / stretch, stretch) * radius_m;
        Rock {
            center_m: feature.center_m,
            diameter_m: feature.diameter_m,
            axes_m,
            site_from_rock: rock_from_site.inverse(),
            unit_from_site: Matrix2::from_diagonal(&axes_m.map(f64::recip)) * rock_from_site.matrix(),
            height_m: at_most(natural_m, self.site_slope * feature.center_m.norm()),
            tilt: MOST_TILT * (2.0 * tint - 1.0),
            albedo: self.albedo_contrast * (tint - 0.6),
        }
    }
}

/// One rock. It stands on the ground below it: what it is at a place is added to the ground there. Where rocks overlap, the
/// tallest is seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rock {
    center_m: Vector2<f64>,
    diameter_m: f64,
    axes_m: Vector2<f64>,
    site_from_rock: Rotation2<f64>,
    /// From offsets in m to the outline's own axes, in which it reaches 1 along both.
    unit_from_site: Matrix2<f64>,
    height_m: f64,
    tilt: f64,
    albedo: f64,
}

impl Bounded for Rock {
    fn circle_m(&self) -> (Vector2<f64>, f64) {
        (self.center_m, self.reach_m())
    }
}

impl Rock {
    /// No rock reaches farther from its centre than this times its diameter.
    pub const REACH_DIAMETERS: f64 = 0.68;

    /// Centre in the site frame, m.
    pub fn center_m(&self) -> Vector2<f64> {
        self.center_m
    }

    /// Diameter in m of the circle that covers as much ground.
    pub fn diameter_m(&self) -> f64 {
        self.diameter_m
    }

    /// Height of the middle over the ground in m.
    pub fn height_m(&self) -> f64 {
        self.height_m
    }

    /// Radius in m of a circle around the outline.
    pub fn reach_m(&self) -> f64 {
        FARTHEST_CORNER * self.axes_m.x
    }

    /// A place in the site frame, m, in a direction of the rock's own axes: 1 = x⁴ + y⁴ + x²y² on the outline, `share` of
    /// the way to it from the centre. Shares beyond 1 lie outside.
    pub fn place_m(&self, direction_rad: f64, share: f64) -> Vector2<f64> {
        let (sin, cos) = direction_rad.sin_cos();
        let (xx, yy) = (cos * cos, sin * sin);
        let to_outline = (xx * xx + yy * yy + xx * yy).powf(-0.25);
        let unit = Vector2::new(cos, sin) * (share * to_outline);
        self.center_m + self.site_from_rock * unit.component_mul(&self.axes_m)
    }

    /// What the rock adds to the ground at a place (m): with (x, y) in the outline's axes, heights fall as
    /// 1 - x⁴ - y⁴ - x²y², times a tilted plane. Nothing outside of the outline; on it, height 0 and the slope inside.
    pub fn sample(&self, at: &Vector2<f64>) -> FeatureSample {
        let at = self.unit_from_site * (at - self.center_m);
        let (xx, yy) = (at.x * at.x, at.y * at.y);
        let inside = 1.0 - xx * xx - yy * yy - xx * yy;
        if inside < -1e-9 {
            return FeatureSample::default();
        }
        let top = self.height_m * (1.0 + self.tilt * at.x);
        let by_at = Vector2::new(
            -top * at.x * (4.0 * xx + 2.0 * yy) + self.height_m * self.tilt * inside,
            -top * at.y * (4.0 * yy + 2.0 * xx),
        );
        FeatureSample {
            height_m: (top * inside).max(0.0),
            gradient: self.unit_from_site.tr_mul(&by_at),
            albedo: self.albedo,
        }
    }

    /// Replaces what stands at a place (m) if the rock is taller there.
    pub(in crate::scene) fn raise(&self, tallest: &mut FeatureSample, at: &Vector2<f64>) {
        if (at - self.center_m).norm_squared() < self.reach_m().powi(2) {
            let rock = self.sample(at);
            if rock.height_m > tallest.height_m {
                *tallest = rock;
            }
        }
    }
}
