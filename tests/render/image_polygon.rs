//! The outline of a flat thing in the picture, and its exact integrals over pixels.

use nalgebra::{Vector2, Vector3};
use opnav::geometry::Camera;

/// Pieces that each edge is cut into, for a lens bends it.
const PIECES: usize = 8;

/// A polygon in pixel coordinates.
#[derive(Debug, Clone)]
pub struct ImagePolygon {
    corners_px: Vec<Vector2<f64>>,
}

impl ImagePolygon {
    /// The picture of a polygon whose corners are given in camera axes.
    pub fn of(camera: &Camera, corners_m: &[Vector3<f64>]) -> Self {
        let next = corners_m.iter().cycle().skip(1);
        let places =
            corners_m.iter().zip(next).flat_map(|(a, b)| (0..PIECES).map(move |k| a.lerp(b, k as f64 / PIECES as f64)));
        ImagePolygon { corners_px: places.map(|p| camera.project(&p).expect("in front of the lens")).collect() }
    }

    /// Mirrored in a picture of this height.
    pub fn upside_down(&self, height_px: u32) -> Self {
        let mirror = |p: &Vector2<f64>| Vector2::new(p.x, f64::from(height_px) - 1.0 - p.y);
        ImagePolygon { corners_px: self.corners_px.iter().map(mirror).collect() }
    }

    /// Centroid of its area in px.
    pub fn centroid(&self) -> Vector2<f64> {
        let (moment, area) = moment_and_area(&self.corners_px);
        moment / area
    }

    /// First and last pixel around it, `margin_px` included.
    pub fn pixels(&self, margin_px: f64) -> (Vector2<i64>, Vector2<i64>) {
        let low = self.corners_px.iter().fold(Vector2::repeat(f64::INFINITY), |low, c| low.inf(c));
        let high = self.corners_px.iter().fold(Vector2::repeat(f64::NEG_INFINITY), |high, c| high.sup(c));
        (low.map(|c| (c - margin_px).floor() as i64), high.map(|c| (c + margin_px).ceil() as i64))
    }

    /// Centroid of the shares of the pixels that it covers: what a perfect renderer would show.
    pub fn sampled_centroid(&self) -> Vector2<f64> {
        let (low, high) = self.pixels(1.0);
        let (mut total, mut weight) = (Vector2::zeros(), 0.0);
        for (u, v) in (low.y..=high.y).flat_map(|v| (low.x..=high.x).map(move |u| (u as f64, v as f64))) {
            let (_, share) = moment_and_area(&self.clipped_to_pixel(u, v));
            total += Vector2::new(u, v) * share;
            weight += share;
        }
        total / weight
    }

    /// Source: Sutherland and Hodgman, "Reentrant polygon clipping", Communications of the ACM 17(1), 1974.
    fn clipped_to_pixel(&self, u: f64, v: f64) -> Vec<Vector2<f64>> {
        let sides = [(0, 1.0, u - 0.5), (0, -1.0, -u - 0.5), (1, 1.0, v - 0.5), (1, -1.0, -v - 0.5)];
        sides.iter().fold(self.corners_px.clone(), |polygon, (axis, sign, limit)| {
            let inside = |p: &Vector2<f64>| sign * p[*axis] - limit;
            let mut kept = Vec::new();
            for (a, b) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
                let (at_a, at_b) = (inside(a), inside(b));
                if at_a >= 0.0 {
                    kept.push(*a);
                }
                if (at_a >= 0.0) != (at_b >= 0.0) {
                    kept.push(a.lerp(b, at_a / (at_a - at_b)));
                }
            }
            kept
        })
    }
}

/// First moment and signed area of a polygon, by Green's theorem.
fn moment_and_area(polygon: &[Vector2<f64>]) -> (Vector2<f64>, f64) {
    let Some(origin) = polygon.first() else { return (Vector2::zeros(), 0.0) };
    let edges = polygon.iter().zip(polygon.iter().cycle().skip(1)).map(|(a, b)| (a - origin, b - origin));
    let (moment, area) = edges.fold((Vector2::zeros(), 0.0), |(moment, area), (a, b)| {
        let cross = a.perp(&b);
        (moment + (a + b) * (cross / 6.0), area + 0.5 * cross)
    });
    (moment + origin * area, area)
}
