//! The law of Oren and Nayar (1994) for a rough surface of Lambertian facets.

use super::directions::PhotometricAngles;

/// C1 and C2 of the qualitative model for facets whose slopes have the standard deviation σ.
pub fn oren_nayar_coefficients(slope_sigma_rad: f64) -> [f64; 2] {
    let variance = slope_sigma_rad * slope_sigma_rad;
    [1.0 - 0.5 * variance / (variance + 0.33), 0.45 * variance / (variance + 0.09)]
}

/// I/F over the albedo: µ₀ (C1 + C2 max(0, cos ψ) sin α tan β), α the larger and β the smaller of incidence and emission.
/// Since cos β = max(µ₀, µ), sin α tan β is sin i sin e / max(µ₀, µ), finite at every angle.
pub(super) fn reflectance(slope_sigma_rad: f64, angles: &PhotometricAngles) -> f64 {
    let (cos_i, cos_e) = angles.cosines();
    let [c1, c2] = oren_nayar_coefficients(slope_sigma_rad);
    let sines = ((1.0 - cos_i * cos_i) * (1.0 - cos_e * cos_e)).sqrt();
    cos_i * (c1 + c2 * angles.azimuth_rad.cos().max(0.0) * sines / cos_i.max(cos_e))
}
