//! Fall of brightness toward the image's edge.

use crate::settings::{OutOfRange, limits};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Relative illumination: cos⁴θ, where switched on, times 1 + a₁r² + a₂r⁴ + a₃r⁶.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct VignettingConfig {
    /// Whether brightness falls with the fourth power of the cosine of the angle θ off the optical axis (default false).
    pub cosine_fourth: bool,
    /// Coefficients a₁, a₂, a₃ of the distance r from the principal point over half the image's diagonal (default 0, 0, 0).
    pub radial: [f64; 3],
}

impl VignettingConfig {
    /// Whether brightness falls at all.
    pub fn is_on(&self) -> bool {
        self.cosine_fourth || self.radial != [0.0; 3]
    }

    /// The polynomial at r².
    pub fn radial_factor(&self, r_squared: f64) -> f64 {
        let [a1, a2, a3] = self.radial;
        1.0 + r_squared * (a1 + r_squared * (a2 + r_squared * a3))
    }

    pub(super) fn validate(&self) -> Result<(), OutOfRange> {
        limits::finite("radial", &self.radial)?;
        let least = (0..=100).map(|i| self.radial_factor((0.01 * f64::from(i)).powi(2))).fold(1.0, f64::min);
        if least < 0.0 {
            let cure = format!("the brightness falls to {least:.3} within the picture: it must not fall below 0");
            return Err(OutOfRange::new("radial", format!("{:?}", self.radial), cure));
        }
        Ok(())
    }
}
