//! The sky that images show behind a body.

use super::catalogue::Star;
use crate::geometry::Camera;
use std::f64::consts::PI;

/// Apparent magnitude of the Sun in V at one astronomical unit.
const SUN_MAGNITUDE: f64 = -26.74;

/// Stars around a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Sky {
    /// Stars, their directions in inertial axes.
    pub stars: Vec<Star>,
    /// Light of a star of magnitude 0 in I/F times px, if it is not to follow from the Sun's.
    pub zero_point_if_px: Option<f64>,
    /// Distance from the scene to the Sun in astronomical units; 0 counts as 1.
    pub sun_distance_au: f64,
}

impl Sky {
    /// Light of a star, summed over the pixels that it falls on, in I/F times px.
    ///
    /// I/F is radiance over E/π, with the Sun's irradiance E at the scene. A star of magnitude m has the irradiance
    /// E d² 10^(0.4 (m_sun - m)) for a scene at the distance d in astronomical units. Spread over one pixel of the solid
    /// angle 1/(fu fv) that is the I/F of π d² fu fv 10^(0.4 (m_sun - m)).
    pub fn light_if_px(&self, star: &Star, camera: &Camera) -> f64 {
        let distance_au = if self.sun_distance_au > 0.0 { self.sun_distance_au } else { 1.0 };
        let from_sun = || {
            let pixels_per_steradian = camera.focal_px.x * camera.focal_px.y;
            PI * distance_au.powi(2) * pixels_per_steradian * 10.0_f64.powf(0.4 * SUN_MAGNITUDE)
        };
        self.zero_point_if_px.unwrap_or_else(from_sun) * 10.0_f64.powf(-0.4 * star.magnitude)
    }
}
