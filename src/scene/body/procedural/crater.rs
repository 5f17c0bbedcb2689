//! Impact craters of a small body.

use super::boulder::SizeLaw;
use nalgebra::Vector3;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Depth of a fresh crater below its rim over its diameter, and height of its rim over its diameter (Melosh, "Impact
/// Cratering", 1989; shallower on small bodies).
const DEPTH_PER_DIAMETER: f64 = 0.15;
const RIM_PER_DIAMETER: f64 = 0.03;
/// The ejecta end at this many radii.
const EJECTA_RADII: f64 = 2.0;

/// A bowl with a raised rim.
pub(super) struct BodyCrater {
    center_m: Vector3<f64>,
    radius_m: f64,
    /// 1 for a fresh crater, less for a worn one.
    freshness: f64,
}

impl BodyCrater {
    /// Crater at a place on the surface.
    pub fn random(center_m: Vector3<f64>, sizes: &SizeLaw, random: &mut ChaCha8Rng) -> Self {
        let radius_m = sizes.radius_m(random.random());
        BodyCrater { center_m, radius_m, freshness: random.random_range(0.4..1.0) }
    }

    /// Change of height in m at a point.
    pub fn height_m(&self, point_m: &Vector3<f64>) -> f64 {
        let x = (point_m - self.center_m).norm() / self.radius_m;
        let (depth, rim) = (DEPTH_PER_DIAMETER - RIM_PER_DIAMETER, RIM_PER_DIAMETER);
        let shape = match x {
            x if x < 1.0 => (depth + rim) * x * x - depth,
            x if x < EJECTA_RADII => rim * ((EJECTA_RADII - x) / (EJECTA_RADII - 1.0)).powi(3),
            _ => 0.0,
        };
        2.0 * self.radius_m * self.freshness * shape
    }
}
