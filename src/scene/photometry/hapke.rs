//! Hapke's law: a semi-infinite layer of grains with a rough surface.

use super::chandrasekhar::chandrasekhar_h;
use super::directions::{LEAST_COSINE, PhotometricAngles};
use crate::settings::{OutOfRange, limits};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_1_PI, PI};

/// Hapke's parameters beside the single-scattering albedo w, which is the material's albedo. The defaults are typical of
/// dark small bodies.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct HapkeParameters {
    /// Asymmetry ξ of the Henyey-Greenstein phase function, the mean cosine of the scattering angle, -0.9 to 0.9 (default
    /// -0.3); negative scatters back to the Sun. It is often written b or g.
    pub asymmetry: f64,
    /// Amplitude B₀ of the opposition surge, 0 to 5 (default 1).
    pub opposition_amplitude: f64,
    /// Angular half-width h of the opposition surge, 0.001 to 1 (default 0.05).
    pub opposition_width: f64,
    /// Mean slope angle θ̄ of the roughness below the resolution of the image in degrees, 0 to 45 (default 20).
    pub roughness_deg: f64,
}

impl Default for HapkeParameters {
    fn default() -> Self {
        HapkeParameters { asymmetry: -0.3, opposition_amplitude: 1.0, opposition_width: 0.05, roughness_deg: 20.0 }
    }
}

/// Below this tan θ̄ the surface counts as smooth (`LEAST_ROUGHNESS` in `shaders/photometry.wgsl`).
const LEAST_ROUGHNESS: f64 = 1e-3;

impl HapkeParameters {
    /// I/F for the single-scattering albedo w: w/4 µ₀ₑ/(µ₀ₑ+µₑ) ((1+B(α)) p(α) + H(µ₀ₑ) H(µₑ) - 1) S.
    pub(super) fn reflectance(&self, w: f64, angles: &PhotometricAngles) -> f64 {
        let w = w.clamp(0.0, 1.0);
        let Effective { cos_incidence, cos_emission, shadowing } = self.effective(angles);
        let surge = self.opposition_amplitude / (1.0 + (0.5 * angles.phase_rad).tan() / self.opposition_width);
        let single = (1.0 + surge) * self.phase_function(angles.phase_rad);
        let multiple = chandrasekhar_h(w, cos_incidence) * chandrasekhar_h(w, cos_emission) - 1.0;
        0.25 * w * cos_incidence / (cos_incidence + cos_emission) * (single + multiple) * shadowing
    }

    /// Henyey and Greenstein's p(α), of mean 1 over the sphere.
    fn phase_function(&self, phase_rad: f64) -> f64 {
        let asymmetry = self.asymmetry;
        let squared = asymmetry * asymmetry;
        (1.0 - squared) / (1.0 + 2.0 * asymmetry * phase_rad.cos() + squared).powf(1.5)
    }

    /// χ = 1/√(1 + π tan² θ̄), and tan θ̄.
    pub fn roughness_factors(&self) -> (f64, f64) {
        let tangent = self.roughness_deg.to_radians().tan();
        (1.0 / (1.0 + PI * tangent * tangent).sqrt(), tangent)
    }

    /// Effective cosines and shadowing of a rough surface (Hapke 1984, Icarus 59, 41; 1993, chapter 12). Both of Hapke's cases
    /// are one when `near` is the smaller of incidence and emission and `far` the larger.
    fn effective(&self, angles: &PhotometricAngles) -> Effective {
        let (cos_incidence, cos_emission) = angles.cosines();
        let (chi, tangent) = self.roughness_factors();
        if tangent < LEAST_ROUGHNESS {
            return Effective { cos_incidence, cos_emission, shadowing: 1.0 };
        }
        let sun_is_near = cos_incidence >= cos_emission;
        let order = |a, b| if sun_is_near { (a, b) } else { (b, a) };
        let (cos_near, cos_far) = order(cos_incidence, cos_emission);
        let (near, far) = (Slopes::new(cos_near, tangent), Slopes::new(cos_far, tangent));
        let azimuth_rad = angles.azimuth_rad;
        let half = (0.5 * azimuth_rad).sin().powi(2);
        let visible = 2.0 - far.e1 - azimuth_rad * FRAC_1_PI * near.e1;
        let tilt_near = (azimuth_rad.cos() * far.e2 + half * near.e2) / visible;
        let tilt_far = (far.e2 - half * near.e2) / visible;
        let effective =
            |cosine: f64, slopes: &Slopes, tilt: f64| (chi * (cosine + slopes.sine_tangent * tilt)).max(LEAST_COSINE);
        let effective_near = effective(cos_near, &near, tilt_near);
        let effective_far = effective(cos_far, &far, tilt_far);
        let (eta_near, eta_far) = (near.eta(cos_near, chi), far.eta(cos_far, chi));

        let shared = (-2.0 * (0.5 * azimuth_rad).tan()).exp();
        let (cos_incidence_e, cos_emission_e) = order(effective_near, effective_far);
        let (eta_incidence, eta_emission) = order(eta_near, eta_far);
        let shadowing = cos_emission_e / eta_emission * cos_incidence / eta_incidence * chi
            / (1.0 - shared + shared * chi * cos_near / eta_near);
        Effective { cos_incidence: cos_incidence_e, cos_emission: cos_emission_e, shadowing }
    }

    pub(super) fn validate(&self) -> Result<(), OutOfRange> {
        limits::within("asymmetry", self.asymmetry, -0.9, 0.9)?;
        limits::within("opposition_amplitude", self.opposition_amplitude, 0.0, 5.0)?;
        limits::within("opposition_width", self.opposition_width, 0.001, 1.0)?;
        limits::within("roughness_deg", self.roughness_deg, 0.0, 45.0)
    }
}

/// µ₀ₑ, µₑ and S of a rough surface.
struct Effective {
    cos_incidence: f64,
    cos_emission: f64,
    shadowing: f64,
}

/// Hapke's E₁ and E₂ of one direction, and its sine times tan θ̄.
struct Slopes {
    e1: f64,
    e2: f64,
    sine_tangent: f64,
}

impl Slopes {
    fn new(cosine: f64, tangent: f64) -> Self {
        let sine_tangent = (1.0 - cosine * cosine).max(0.0).sqrt() * tangent;
        let cotangents = cosine / sine_tangent.max(1e-9);
        Slopes {
            e1: (-2.0 * FRAC_1_PI * cotangents).exp(),
            e2: (-FRAC_1_PI * cotangents * cotangents).exp(),
            sine_tangent,
        }
    }

    /// Effective cosine of a direction with the other in the same vertical plane.
    fn eta(&self, cosine: f64, chi: f64) -> f64 {
        chi * (cosine + self.sine_tangent * self.e2 / (2.0 - self.e1))
    }
}
