//! Features of a rectangle sorted into bins, so that a place asks only those near it.

use nalgebra::Vector2;

/// Bins along each edge.
const SIDE: usize = 8;

/// A circle outside which a feature does nothing.
pub trait Bounded {
    /// Centre in the site frame and radius, in m.
    fn circle_m(&self) -> (Vector2<f64>, f64);
}

/// Features in their order, once for each bin that they touch.
#[derive(Debug, Clone)]
pub struct Bins<F> {
    low_m: Vector2<f64>,
    bins_per_m: Vector2<f64>,
    bins: Vec<Vec<F>>,
}

impl<F: Bounded + Copy> Bins<F> {
    /// Bins between two corners (m).
    pub fn new(features: impl Iterator<Item = F>, low_m: &Vector2<f64>, high_m: &Vector2<f64>) -> Self {
        let edge_m = high_m - low_m;
        let bins_per_m = edge_m.map(|e| if e > 0.0 { SIDE as f64 / e } else { 0.0 });
        let mut found = Bins { low_m: *low_m, bins_per_m, bins: vec![Vec::new(); SIDE * SIDE] };
        for feature in features {
            let (center_m, radius_m) = feature.circle_m();
            // A little wider, so that rounding loses none.
            let reach_m = radius_m * (1.0 + 1e-9) + 1e-9;
            let [first_x, first_y] = found.bin(&center_m.add_scalar(-reach_m));
            let [last_x, last_y] = found.bin(&center_m.add_scalar(reach_m));
            for y in first_y..=last_y {
                found.bins[y * SIDE + first_x..=y * SIDE + last_x].iter_mut().for_each(|bin| bin.push(feature));
            }
        }
        found
    }

    /// Features that may reach a place (m) of the rectangle.
    pub fn near(&self, at: &Vector2<f64>) -> &[F] {
        let [x, y] = self.bin(at);
        &self.bins[y * SIDE + x]
    }

    fn bin(&self, at: &Vector2<f64>) -> [usize; 2] {
        let bin = (at - self.low_m).component_mul(&self.bins_per_m);
        [bin.x, bin.y].map(|b| (b.max(0.0) as usize).min(SIDE - 1))
    }
}
