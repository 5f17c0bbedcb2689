//! Where a ray meets the analytic terrain.

use super::terrain::Terrain;
use nalgebra::{Unit, Vector3};

/// Rays end here.
const FARTHEST_M: f64 = 300_000.0;

impl Terrain {
    /// Range in m along a unit direction to the first crossing of the ground from above, to about 1e-9 of the range;
    /// `None` if the ray starts below the ground or leaves without meeting it. Both are in the site frame.
    pub fn ray_cast(&self, origin_in_site_m: &Vector3<f64>, direction: &Unit<Vector3<f64>>) -> Option<f64> {
        let clearance_m = |range_m: f64| {
            let p = origin_in_site_m + direction.as_ref() * range_m;
            p.z - self.height_m(p.x, p.y)
        };
        let closing = self.steepest(FARTHEST_M) * direction.xy().norm() - direction.z;
        let highest_m = self.highest_m();
        let mut range_m = 0.0;
        let mut clear_m = clearance_m(0.0);
        if clear_m <= 0.0 || closing <= 0.0 {
            return None;
        }
        while range_m < FARTHEST_M && (direction.z < 0.0 || origin_in_site_m.z + direction.z * range_m < highest_m) {
            let next_m = range_m + (clear_m / closing).max(1e-9 * (1.0 + range_m));
            let next_clear_m = clearance_m(next_m);
            if next_clear_m <= 0.0 {
                return Some(bisect(range_m, next_m, clearance_m));
            }
            if next_clear_m < 1e-10 * (1.0 + next_m) {
                return Some(next_m);
            }
            (range_m, clear_m) = (next_m, next_clear_m);
        }
        None
    }
}

fn bisect(mut above_m: f64, mut below_m: f64, clearance_m: impl Fn(f64) -> f64) -> f64 {
    while below_m - above_m > 1e-10 * (1.0 + below_m) {
        let middle_m = 0.5 * (above_m + below_m);
        if clearance_m(middle_m) > 0.0 {
            above_m = middle_m;
        } else {
            below_m = middle_m;
        }
    }
    0.5 * (above_m + below_m)
}
