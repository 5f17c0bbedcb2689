//! The lattice of one octave of noise in a rectangle, hashed once.

use super::gradient_noise::{Corners, PointGradients, point_gradients};
use super::octave::NoiseOctave;
use nalgebra::Vector2;

/// Rectangles with more lattice points are not worth a table.
const MOST_POINTS: i64 = 1 << 14;

/// Gradients of an octave's lattice points in and around a rectangle.
#[derive(Debug, Clone)]
pub struct NoiseTable {
    first: [i64; 2],
    columns: usize,
    gradients: Vec<PointGradients>,
}

impl NoiseTable {
    /// The points that places between two corners (m) need; `None` where they are too many.
    pub fn covering(octave: &NoiseOctave, low_m: &Vector2<f64>, high_m: &Vector2<f64>) -> Option<NoiseTable> {
        let corners = [[low_m.x, low_m.y], [high_m.x, low_m.y], [low_m.x, high_m.y], [high_m.x, high_m.y]];
        let lattice = corners.map(|[x_m, y_m]| octave.planar_lattice(x_m, y_m));
        let ends = [0, 1].map(|axis| {
            let along = lattice.map(|point| point[axis]);
            let least = along.iter().copied().fold(f64::INFINITY, f64::min);
            let most = along.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            // Rounding can put a place of the rectangle's edge into the next cell.
            [(least - 1e-6).floor() as i64, (most + 1e-6).floor() as i64 + 1]
        });
        let [columns, rows] = ends.map(|[first, last]| last.saturating_sub(first).saturating_add(1));
        if columns.saturating_mul(rows) > MOST_POINTS {
            return None;
        }
        let [[first_x, last_x], [first_y, last_y]] = ends;
        let points = (first_y..=last_y).flat_map(|y| (first_x..=last_x).map(move |x| (x, y)));
        let gradients = points.map(|(x, y)| point_gradients(x, y, octave.seed)).collect();
        Some(NoiseTable { first: [first_x, first_y], columns: columns as usize, gradients })
    }

    /// Gradients at the corners of a cell of the rectangle.
    pub(super) fn corners(&self, [x, y]: [i64; 2]) -> Corners {
        let at = (y - self.first[1]) as usize * self.columns + (x - self.first[0]) as usize;
        let above = at + self.columns;
        [self.gradients[at], self.gradients[at + 1], self.gradients[above], self.gradients[above + 1]]
    }
}
