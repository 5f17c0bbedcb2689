//! A known point, as seen in one image.

use nalgebra::{Vector2, Vector3};

/// A point of known place, seen in an image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KnownSighting {
    /// Time of the image, ns.
    pub t_ns: i64,
    /// Pixel (u, v).
    pub pixel_px: Vector2<f64>,
    /// 1σ of each pixel coordinate, px.
    pub sigma_px: f64,
    /// The point in the site frame, m.
    pub point_in_site_m: Vector3<f64>,
    /// 1σ of each of its coordinates, m.
    pub sigma_point_m: f64,
}
