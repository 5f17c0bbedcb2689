//! How large the Sun's disc is.

/// Nominal solar radius in m (IAU 2015 resolution B3).
const SUN_RADIUS_M: f64 = 6.957e8;
/// Astronomical unit in m (IAU 2012 resolution B2).
const ASTRONOMICAL_UNIT_M: f64 = 1.495_978_707e11;

/// Half the angle that the Sun's disc spans, in rad, from a distance in astronomical units; a distance of 0 asks for a
/// point, which spans nothing.
pub fn sun_angular_radius_rad(distance_au: f64) -> f64 {
    if distance_au > 0.0 { (SUN_RADIUS_M / (distance_au * ASTRONOMICAL_UNIT_M)).min(1.0).asin() } else { 0.0 }
}
