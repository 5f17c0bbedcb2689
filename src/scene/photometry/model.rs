//! The choice of a photometric model.

use super::directions::PhotometricAngles;
use super::hapke::HapkeParameters;
use super::lunar_lambert::LunarWeight;
use super::{lunar_lambert, oren_nayar};
use crate::settings::{OutOfRange, limits};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How a material scatters sunlight. The formulas and their sources stand in the documentation of `scene::photometry`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub enum Photometry {
    /// Lambert's law.
    Lambert,
    /// The law of Lommel and Seeliger, scaled so that the albedo is I/F at zero phase.
    LommelSeeliger,
    /// McEwen's mixture of both.
    LunarLambert {
        /// Weight L of the Lommel-Seeliger part: a number from 0 to 1, or the coefficients [A, B, C] of
        /// L = 1 + A α + B α² + C α³, α being the phase in degrees.
        weight: LunarWeight,
    },
    /// Rough surface of Lambertian facets.
    OrenNayar {
        /// Standard deviation σ of the facets' slope angle in degrees, 0 to 60.
        slope_sigma_deg: f64,
    },
    /// Layer of grains; the material's albedo is the single-scattering albedo w.
    Hapke(HapkeParameters),
}

impl Default for Photometry {
    /// Lunar-Lambert with the constant weight 0.6.
    fn default() -> Self {
        Photometry::LunarLambert { weight: LunarWeight::Constant(0.6) }
    }
}

impl Photometry {
    /// I/F of a place: its radiance over that of a perfect Lambert surface with the Sun in its zenith. 0 where the Sun is
    /// below the horizon of the place.
    pub fn reflectance(&self, albedo: f64, angles: &PhotometricAngles) -> f64 {
        if angles.cos_incidence <= 0.0 {
            return 0.0;
        }
        let (cos_i, cos_e) = angles.cosines();
        let lunar = |weight| albedo * lunar_lambert::reflectance(weight, cos_i, cos_e);
        match self {
            Photometry::Lambert => albedo * cos_i,
            Photometry::LommelSeeliger => lunar(1.0),
            Photometry::LunarLambert { weight } => lunar(weight.at(angles.phase_rad)),
            Photometry::OrenNayar { slope_sigma_deg } => {
                albedo * oren_nayar::reflectance(slope_sigma_deg.to_radians(), angles)
            }
            Photometry::Hapke(parameters) => parameters.reflectance(albedo, angles),
        }
    }

    /// Checks every parameter's range.
    pub(super) fn validate_parameters(&self) -> Result<(), OutOfRange> {
        match self {
            Photometry::Lambert | Photometry::LommelSeeliger => Ok(()),
            Photometry::LunarLambert { weight } => weight.validate().map_err(|e| e.under("lunar-lambert")),
            Photometry::OrenNayar { slope_sigma_deg } => {
                limits::within("oren-nayar.slope_sigma_deg", *slope_sigma_deg, 0.0, 60.0)
            }
            Photometry::Hapke(parameters) => parameters.validate().map_err(|e| e.under("hapke")),
        }
    }
}
