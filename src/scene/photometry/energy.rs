//! How much of the light that falls on a surface leaves it.

use super::directions::PhotometricAngles;
use super::model::Photometry;
use crate::settings::OutOfRange;
use std::f64::consts::PI;

/// Rings of equal solid angle, and sectors of half a turn, in the integral over the hemisphere.
const STEPS: (u32, u32) = (48, 48);
/// Incidences at which a material is checked, in degrees.
const CHECKED_INCIDENCES_DEG: [f64; 8] = [0.0, 30.0, 50.0, 65.0, 75.0, 82.0, 86.0, 89.0];

impl Photometry {
    /// Directional-hemispherical reflectance: the share of light from one incidence (rad) that leaves into the hemisphere,
    /// 1/(π µ₀) ∫ I/F µ dΩ (Hapke 1993, chapter 10), by the midpoint rule.
    pub fn directional_hemispherical(&self, albedo: f64, incidence_rad: f64) -> f64 {
        let (rings, sectors) = STEPS;
        let mut total = 0.0;
        for ring in 0..rings {
            let cos_emission = (f64::from(ring) + 0.5) / f64::from(rings);
            for sector in 0..sectors {
                let azimuth_rad = PI * (f64::from(sector) + 0.5) / f64::from(sectors);
                let angles = PhotometricAngles::from_angles(incidence_rad, cos_emission.acos(), azimuth_rad);
                total += 2.0 * cos_emission * self.reflectance(albedo, &angles);
            }
        }
        total / f64::from(rings * sectors) / incidence_rad.cos()
    }

    /// Checks every parameter's range, and that a surface with this albedo reflects no more light than it receives.
    ///
    /// # Errors
    /// Names the first key at fault: `photometry` with its parameters, or `albedo`.
    pub fn validate(&self, albedo: f64) -> Result<(), OutOfRange> {
        self.validate_parameters().map_err(|e| e.under("photometry"))?;
        for incidence_deg in CHECKED_INCIDENCES_DEG {
            let share = self.directional_hemispherical(albedo, incidence_deg.to_radians());
            if share > 1.0 {
                let cure = format!(
                    "with this photometry the surface would send back {share:.2} times the light that reaches it at an \
                     incidence of {incidence_deg}°: lower the albedo"
                );
                return Err(OutOfRange::new("albedo", albedo, cure));
            }
        }
        Ok(())
    }
}
