//! The lunar-Lambert law of McEwen (1991, 1996), with Lambert's and Lommel-Seeliger's laws as its ends.

use crate::settings::{OutOfRange, limits};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Weight L of the Lommel-Seeliger part.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "a number L, or three coefficients [A, B, C] of L = 1 + A α + B α² + C α³ with α in degrees"
)]
pub enum LunarWeight {
    /// The same L, 0 to 1, at every phase.
    Constant(f64),
    /// L(α) = 1 + A α + B α² + C α³ with α in degrees, kept between 0 and 1.
    Phase([f64; 3]),
}

impl LunarWeight {
    /// The Moon's: A = -0.019, B = 2.42e-4, C = -1.46e-6 (McEwen 1996).
    pub const MOON: LunarWeight = LunarWeight::Phase([-0.019, 2.42e-4, -1.46e-6]);

    /// L at a phase.
    pub fn at(&self, phase_rad: f64) -> f64 {
        match self {
            LunarWeight::Constant(weight) => *weight,
            LunarWeight::Phase([a, b, c]) => {
                let phase_deg = phase_rad.to_degrees();
                (1.0 + phase_deg * (a + phase_deg * (b + phase_deg * c))).clamp(0.0, 1.0)
            }
        }
    }

    /// Coefficients of 1, α, α² and α³ with α in rad, before the clamp.
    pub fn coefficients(&self) -> [f64; 4] {
        let degrees: f64 = 1.0_f64.to_degrees();
        match self {
            LunarWeight::Constant(weight) => [*weight, 0.0, 0.0, 0.0],
            LunarWeight::Phase([a, b, c]) => [1.0, a * degrees, b * degrees.powi(2), c * degrees.powi(3)],
        }
    }

    pub(super) fn validate(&self) -> Result<(), OutOfRange> {
        match self {
            LunarWeight::Constant(weight) => limits::within("weight", *weight, 0.0, 1.0),
            LunarWeight::Phase(coefficients) => limits::finite("weight", coefficients),
        }
    }
}

/// I/F over the albedo: 2 L µ₀/(µ₀+µ) + (1-L) µ₀.
pub(super) fn reflectance(weight: f64, cos_incidence: f64, cos_emission: f64) -> f64 {
    cos_incidence * (2.0 * weight / (cos_incidence + cos_emission) + 1.0 - weight)
}
