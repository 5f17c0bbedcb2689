//! Sunlight as it reaches a scene.

use crate::settings::{OutOfRange, limits};
use nalgebra::{Unit, Vector3};

/// Nominal solar radius in m (IAU 2015 resolution B3).
const SUN_RADIUS_M: f64 = 6.957e8;
/// Astronomical unit in m (IAU 2012 resolution B2).
pub(super) const ASTRONOMICAL_UNIT_M: f64 = 1.495_978_707e11;

/// Sunlight, in the frame that its maker names.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sunlight {
    /// Direction to the Sun.
    pub direction: Unit<Vector3<f64>>,
    /// Distance to the Sun in astronomical units; 0 makes it a point.
    pub distance_au: f64,
}

impl Sunlight {
    /// Half the angle that the Sun's disc spans, in rad.
    pub fn angular_radius_rad(&self) -> f64 {
        sun_angular_radius_rad(self.distance_au)
    }
}

/// Half the angle that the Sun's disc spans, in rad, from a distance in astronomical units; a distance of 0 asks for a
/// point, which spans nothing.
pub fn sun_angular_radius_rad(distance_au: f64) -> f64 {
    if distance_au > 0.0 { (SUN_RADIUS_M / (distance_au * ASTRONOMICAL_UNIT_M)).min(1.0).asin() } else { 0.0 }
}

/// The direction of a vector of any length but 0.
pub fn direction(key: &str, vector: &[f64; 3]) -> Result<Unit<Vector3<f64>>, OutOfRange> {
    limits::finite(key, vector)?;
    Unit::try_new(Vector3::from(*vector), 1e-12)
        .ok_or_else(|| OutOfRange::new(key, format!("{vector:?}"), "it must not be the zero vector"))
}
