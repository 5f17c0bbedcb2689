//! Torque-free rotation of a rigid body and its derivatives.

use super::inertia::{InertiaRatios, xi};
use crate::geometry::so3::hat;
use nalgebra::{Matrix3, SMatrix, Vector3};

/// Euler's equations of a free body: `L ω̇ + ω × L ω = 0` (Deng et al. 2024, equation 14), ω in asteroid axes.
#[derive(Debug, Clone, PartialEq)]
pub struct FreeBody {
    tensor: Matrix3<f64>,
    inverse: Matrix3<f64>,
}

impl FreeBody {
    /// The body with these ratios; `None` if its tensor cannot be inverted.
    pub fn new(inertia: &InertiaRatios) -> Option<Self> {
        let tensor = inertia.tensor();
        let inverse = tensor.try_inverse()?;
        inverse.iter().all(|e| e.is_finite()).then_some(FreeBody { tensor, inverse })
    }

    /// Angular acceleration (rad/s², asteroid axes) at the rate (rad/s).
    pub fn acceleration_rad_s2(&self, rate_rad_s: &Vector3<f64>) -> Vector3<f64> {
        -self.inverse * rate_rad_s.cross(&(self.tensor * rate_rad_s))
    }

    /// M, the derivative (1/s) of the acceleration by the rate: `L⁻¹([Lω×] - [ω×]L)` (equation 24).
    pub fn acceleration_by_rate(&self, rate_rad_s: &Vector3<f64>) -> Matrix3<f64> {
        self.inverse * (hat(&(self.tensor * rate_rad_s)) - hat(rate_rad_s) * self.tensor)
    }

    /// N, the derivative (rad/s²) of the acceleration by the ratios: `-L⁻¹(Ξ(ω̇) + [ω×] Ξ(ω))` (equation 24).
    pub fn acceleration_by_inertia(&self, rate_rad_s: &Vector3<f64>) -> SMatrix<f64, 3, 5> {
        let acceleration = self.acceleration_rad_s2(rate_rad_s);
        -self.inverse * (xi(&acceleration) + hat(rate_rad_s) * xi(rate_rad_s))
    }
}
