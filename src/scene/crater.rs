//! Impact craters scattered over the plane by hashing, so that every place can be evaluated on its own.
//!
//! Diameters follow a power law N(>D) ~ D^-b; each class of one octave of diameters has its own grid, one possible crater
//! a cell.

use super::noise::pcg2d;
use nalgebra::Vector2;

/// Height, gradient and relative albedo that craters add at a place.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CraterSample {
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
    /// Smallest diameter of the class in m; the largest is twice that.
    pub smallest_m: f64,
    /// Probability that a cell holds a crater.
    pub probability: f64,
    /// Seeds of the grid's hash.
    pub seed: [u32; 2],
    /// Exponent b of the power law.
    pub exponent: f64,
    /// Depth of a fresh crater over its diameter.
    pub depth_ratio: f64,
    /// No crater is deeper than this times its distance from the origin.
    pub site_slope: f64,
    /// Relative change of the albedo by the freshest craters' ejecta.
    pub albedo_contrast: f64,
}

/// Reach of a crater in radii: ejecta end here.
const REACH_RADII: f64 = 3.0;
/// Cell edge over the smallest diameter: twice the reach of the largest crater, so that the four nearest cells suffice.
const CELL_DIAMETERS: f64 = 6.0;

struct Crater {
    center_m: Vector2<f64>,
    radius_m: f64,
    depth_m: f64,
    freshness: f64,
    albedo: f64,
}

impl CraterClass {
    /// What this class adds at a place (m).
    pub fn sample(&self, x_m: f64, y_m: f64) -> CraterSample {
        let cell_m = CELL_DIAMETERS * self.smallest_m;
        let (first_x, first_y) = ((x_m / cell_m - 0.5).floor() as i64, (y_m / cell_m - 0.5).floor() as i64);
        let mut total = CraterSample::default();
        for (step_x, step_y) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            if let Some(crater) = self.crater(first_x + step_x, first_y + step_y, cell_m) {
                crater.add_to(&mut total, x_m, y_m);
            }
        }
        total
    }

    fn crater(&self, cell_x: i64, cell_y: i64, cell_m: f64) -> Option<Crater> {
        let first = pcg2d(cell_x as u32 ^ self.seed[0], cell_y as u32 ^ self.seed[1]);
        let unit = |h: u32| f64::from(h) / 65536.0;
        if unit(first[0] & 0xffff) >= self.probability {
            return None;
        }
        let second = pcg2d(first[0], first[1]);
        let center_m = Vector2::new(
            (cell_x as f64 + unit(first[1] & 0xffff)) * cell_m,
            (cell_y as f64 + unit(first[1] >> 16)) * cell_m,
        );
        // Inverse of the power law inside one octave of diameters.
        let spread = 1.0 - unit(second[0] & 0xffff) * (1.0 - 0.5_f64.powf(self.exponent));
        let diameter_m = self.smallest_m * spread.powf(-1.0 / self.exponent);
        let freshness = unit(first[0] >> 16).powi(2);
        let natural_m = diameter_m * self.depth_ratio * (0.12 + 0.88 * freshness) / (1.0 + diameter_m / 400.0);
        let allowed_m = self.site_slope * center_m.norm();
        Some(Crater {
            center_m,
            radius_m: 0.5 * diameter_m,
            depth_m: natural_m * allowed_m / (natural_m + allowed_m).max(1e-12),
            freshness,
            albedo: self.albedo_contrast * (2.0 * unit(second[0] >> 16) - 1.0) * (0.3 + 0.7 * freshness),
        })
    }
}

impl Crater {
    fn add_to(&self, total: &mut CraterSample, x_m: f64, y_m: f64) {
        let from_center = Vector2::new(x_m, y_m) - self.center_m;
        let distance_m = from_center.norm();
        let t = distance_m / self.radius_m;
        if t >= REACH_RADII {
            return;
        }
        let (height_m, slope) = self.profile(t);
        total.height_m += height_m;
        if distance_m > 0.0 {
            total.gradient += from_center * (slope / (self.radius_m * distance_m));
        }
        let taper = 1.0 - (t / REACH_RADII).powi(2);
        total.albedo += self.albedo * taper.powi(3);
    }

    /// Height at `t` radii from the centre, and its derivative by `t`: a bowl inside the rim, and a rim that widens as it
    /// degrades.
    fn profile(&self, t: f64) -> (f64, f64) {
        let rim_m = self.depth_m * 0.22 * (0.4 + 0.6 * self.freshness);
        let width = 0.35 - 0.17 * self.freshness;
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
