//! The angles that a reflectance depends on.

use nalgebra::Vector3;

/// Angles at one place of a surface: incidence i and emission e from the normal, phase α between the directions to Sun and
/// camera, and the azimuth ψ between them around the normal. They are bound by cos α = cos i cos e + sin i sin e cos ψ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PhotometricAngles {
    /// µ₀, cosine of the incidence; at or below 0 the place is dark.
    pub cos_incidence: f64,
    /// µ, cosine of the emission; below 0 it counts as 0.
    pub cos_emission: f64,
    /// Phase in rad, 0 to π.
    pub phase_rad: f64,
    /// Azimuth in rad, 0 to π; 0 where Sun and camera stand on the same side.
    pub azimuth_rad: f64,
}

impl PhotometricAngles {
    /// Angles of the unit vectors of normal, Sun and camera, whatever their frame.
    pub fn new(normal: &Vector3<f64>, to_sun: &Vector3<f64>, to_camera: &Vector3<f64>) -> Self {
        let across = |v: &Vector3<f64>| v - normal * normal.dot(v);
        PhotometricAngles {
            cos_incidence: normal.dot(to_sun),
            cos_emission: normal.dot(to_camera),
            phase_rad: angle_rad(to_sun, to_camera),
            azimuth_rad: angle_rad(&across(to_sun), &across(to_camera)),
        }
    }

    /// Angles of incidence, emission and azimuth in rad.
    pub fn from_angles(incidence_rad: f64, emission_rad: f64, azimuth_rad: f64) -> Self {
        let (sin_i, cos_i) = incidence_rad.sin_cos();
        let (sin_e, cos_e) = emission_rad.sin_cos();
        let to_sun = Vector3::new(sin_i, 0.0, cos_i);
        let to_camera = Vector3::new(sin_e * azimuth_rad.cos(), sin_e * azimuth_rad.sin(), cos_e);
        PhotometricAngles { azimuth_rad, ..PhotometricAngles::new(&Vector3::z(), &to_sun, &to_camera) }
    }

    /// The same place with Sun and camera exchanged.
    pub fn exchanged(&self) -> Self {
        PhotometricAngles { cos_incidence: self.cos_emission, cos_emission: self.cos_incidence, ..*self }
    }

    /// The cosines kept where a reflectance is defined, from `LEAST_COSINE` to 1.
    pub(super) fn cosines(&self) -> (f64, f64) {
        (self.cos_incidence.clamp(LEAST_COSINE, 1.0), self.cos_emission.clamp(LEAST_COSINE, 1.0))
    }
}

/// Cosine of the most grazing directions told apart: keeps every quotient finite (`LEAST_COSINE` in
/// `shaders/photometry.wgsl`).
pub(super) const LEAST_COSINE: f64 = 1e-4;

/// Angle between two vectors, exact near 0 and π too (Kahan 2006); 0 where one of them vanishes.
fn angle_rad(a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    a.cross(b).norm().atan2(a.dot(b))
}
