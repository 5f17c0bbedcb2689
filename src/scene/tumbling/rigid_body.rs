//! Torque-free motion of a rigid body.

use crate::settings::OutOfRange;
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};

/// Turn of one integration step, rad: with the classical Runge–Kutta method it keeps energy and angular momentum to
/// about 1e-12 over ten minutes of a body that turns in one.
const STEP_RAD: f64 = 1e-3;

/// Attitude and rate of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spin {
    /// Attitude: takes inertial axes to asteroid axes.
    pub asteroid_from_inertial: UnitQuaternion<f64>,
    /// Angular rate in asteroid axes, rad/s.
    pub rate_in_asteroid_rad_s: Vector3<f64>,
}

/// A rigid body without torque.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidBody {
    inertia: Matrix3<f64>,
    inverse_inertia: Matrix3<f64>,
}

impl RigidBody {
    /// Body with the inertia tensor in asteroid axes, to scale only.
    ///
    /// # Errors
    /// Names the key `inertia` if the tensor is not symmetric, not positive definite, or breaks the triangle inequality
    /// of principal moments, so that no body has it.
    pub fn new(inertia: &Matrix3<f64>) -> Result<Self, OutOfRange> {
        let fault = |cure: &str| OutOfRange::new("inertia", format!("{:?}", rows(inertia)), cure);
        if !inertia.iter().all(|v| v.is_finite()) {
            return Err(fault("every element must be a finite number"));
        }
        if (inertia - inertia.transpose()).abs().max() > 1e-9 * inertia.abs().max() {
            return Err(fault("the tensor must be symmetric"));
        }
        let moments = crate::scene::body::principal_moments(inertia);
        if moments[0] <= 1e-12 * moments[2] {
            return Err(fault("the tensor must be positive definite"));
        }
        if moments[0] + moments[1] < moments[2] * (1.0 - 1e-12) {
            return Err(fault("no body has it: the two smaller principal moments must add up to the largest or more"));
        }
        let inverse_inertia = inertia.try_inverse().ok_or_else(|| fault("the tensor must be positive definite"))?;
        Ok(RigidBody { inertia: *inertia, inverse_inertia })
    }

    /// Inertia tensor in asteroid axes.
    pub fn inertia(&self) -> &Matrix3<f64> {
        &self.inertia
    }

    /// Euler's equation: `ω̇ = L⁻¹ (-ω × L ω)`, in asteroid axes, rad/s².
    pub fn rate_derivative(&self, rate_in_asteroid_rad_s: &Vector3<f64>) -> Vector3<f64> {
        let momentum = self.inertia * rate_in_asteroid_rad_s;
        self.inverse_inertia * momentum.cross(rate_in_asteroid_rad_s)
    }

    /// Twice the kinetic energy, `ωᵀ L ω`.
    pub fn doubled_energy(&self, spin: &Spin) -> f64 {
        spin.rate_in_asteroid_rad_s.dot(&(self.inertia * spin.rate_in_asteroid_rad_s))
    }

    /// Angular momentum in inertial axes; constant.
    pub fn momentum_in_inertial(&self, spin: &Spin) -> Vector3<f64> {
        spin.asteroid_from_inertial.inverse() * (self.inertia * spin.rate_in_asteroid_rad_s)
    }

    /// The motion `dt_s` seconds later (earlier if negative), by the classical Runge–Kutta method in small steps.
    pub fn propagate(&self, spin: &Spin, dt_s: f64) -> Spin {
        // The rate cannot exceed this, whatever the motion: |L ω| is constant and |ω| ≤ |L⁻¹| |L ω|.
        let fastest_rad_s = self.inverse_inertia.norm() * (self.inertia * spin.rate_in_asteroid_rad_s).norm();
        let steps = (fastest_rad_s * dt_s.abs() / STEP_RAD).ceil().max(1.0);
        let mut state = (spin.asteroid_from_inertial.into_inner(), spin.rate_in_asteroid_rad_s);
        for _ in 0..steps as u64 {
            state = self.stepped(state, dt_s / steps);
        }
        Spin { asteroid_from_inertial: UnitQuaternion::new_normalize(state.0), rate_in_asteroid_rad_s: state.1 }
    }

    fn stepped(&self, (q, w): (Quaternion<f64>, Vector3<f64>), h: f64) -> (Quaternion<f64>, Vector3<f64>) {
        let (q1, w1) = self.derivative(&q, &w);
        let (q2, w2) = self.derivative(&(q + q1 * (0.5 * h)), &(w + w1 * (0.5 * h)));
        let (q3, w3) = self.derivative(&(q + q2 * (0.5 * h)), &(w + w2 * (0.5 * h)));
        let (q4, w4) = self.derivative(&(q + q3 * h), &(w + w3 * h));
        let q = q + (q1 + (q2 + q3) * 2.0 + q4) * (h / 6.0);
        (q.normalize(), w + (w1 + (w2 + w3) * 2.0 + w4) * (h / 6.0))
    }

    /// The rotation matrix A that takes inertial to asteroid axes obeys `Ȧ = -[ω×] A`, so `q̇ = -½ (0, ω) q`.
    fn derivative(&self, q: &Quaternion<f64>, w: &Vector3<f64>) -> (Quaternion<f64>, Vector3<f64>) {
        (Quaternion::from_imag(*w) * q * -0.5, self.rate_derivative(w))
    }
}

/// Rows of a tensor, as scenario and truth files write it.
pub(super) fn rows(matrix: &Matrix3<f64>) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| matrix[(row, column)]))
}
