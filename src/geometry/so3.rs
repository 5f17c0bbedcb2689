//! The rotation group SO(3): exponential, logarithm, plus, minus and the Jacobians of the exponential.
//!
//! For `q = exp(phi)`: a small change of the tangent vector acts on the right through the right Jacobian,
//! `exp(phi + d) ≈ exp(phi) exp(J_r(phi) d)`, and on the left through the left one,
//! `exp(phi + d) ≈ exp(J_l(phi) d) exp(phi)`. Source: Solà, Deray, Atchuthan, "A micro Lie theory for state estimation
//! in robotics" (2018), equations (143) to (146).

use nalgebra::{Matrix3, SVector, Unit, UnitQuaternion, Vector3};

/// A state with a tangent space of dimension `N`: `x.plus(d)` moves along it and `truth.minus(estimate)` measures in it.
///
/// The law that every implementation keeps: `x.plus(y.minus(x)) == y` and `x.plus(d).minus(x) == d` for small `d`.
pub trait Manifold<const N: usize>: Sized {
    /// The state moved by the tangent vector `d`.
    fn plus(&self, d: &SVector<f64, N>) -> Self;
    /// The tangent vector that leads from `other` to `self`.
    fn minus(&self, other: &Self) -> SVector<f64, N>;
}

impl Manifold<3> for UnitQuaternion<f64> {
    /// `a_from_b.plus(d) = a_from_b * exp(d)`, with `d` in radians in the frame `b`.
    fn plus(&self, d: &Vector3<f64>) -> Self {
        self * exp(d)
    }
    fn minus(&self, other: &Self) -> Vector3<f64> {
        log(&(other.inverse() * self))
    }
}

impl<const N: usize> Manifold<N> for SVector<f64, N> {
    fn plus(&self, d: &SVector<f64, N>) -> Self {
        self + d
    }
    fn minus(&self, other: &Self) -> SVector<f64, N> {
        self - other
    }
}

/// Cross-product matrix: `hat(a) * b == a.cross(&b)`.
pub fn hat(v: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(0.0, -v.z, v.y, v.z, 0.0, -v.x, -v.y, v.x, 0.0)
}

/// Rotation by `|phi_rad|` radians about `phi_rad`.
pub fn exp(phi_rad: &Vector3<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::from_scaled_axis(*phi_rad)
}

/// Rotation vector of `q` in radians, of length at most π. Exact for small angles and stable at half a turn.
pub fn log(q: &UnitQuaternion<f64>) -> Vector3<f64> {
    let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
    let v = q.imag() * sign;
    let sine = v.norm();
    if sine < 1e-12 {
        return v * 2.0;
    }
    v * (2.0 * sine.atan2(q.w * sign) / sine)
}

/// Left Jacobian of the exponential at `phi_rad`.
pub fn left_jacobian(phi_rad: &Vector3<f64>) -> Matrix3<f64> {
    let angle = phi_rad.norm();
    let k = hat(phi_rad);
    let (a, b) = if angle < 1e-4 {
        (0.5 - angle * angle / 24.0, 1.0 / 6.0 - angle * angle / 120.0)
    } else {
        // (1 - cos a) / a² by the half angle, which loses no digits
        (0.5 * ((0.5 * angle).sin() / (0.5 * angle)).powi(2), (angle - angle.sin()) / angle.powi(3))
    };
    Matrix3::identity() + k * a + k * k * b
}

/// Right Jacobian of the exponential at `phi_rad`.
pub fn right_jacobian(phi_rad: &Vector3<f64>) -> Matrix3<f64> {
    left_jacobian(&-phi_rad)
}

/// Inverse of [`left_jacobian`]; `phi_rad` shorter than a full turn.
pub fn left_jacobian_inverse(phi_rad: &Vector3<f64>) -> Matrix3<f64> {
    let angle = phi_rad.norm();
    let k = hat(phi_rad);
    let c = if angle < 1e-3 {
        1.0 / 12.0 + angle * angle / 720.0
    } else {
        // (1 + cos a) / sin a = 1 / tan(a/2), which stays exact at half a turn
        1.0 / (angle * angle) - 1.0 / (2.0 * angle * (0.5 * angle).tan())
    };
    Matrix3::identity() - k * 0.5 + k * k * c
}

/// Inverse of [`right_jacobian`]; `phi_rad` shorter than a full turn.
pub fn right_jacobian_inverse(phi_rad: &Vector3<f64>) -> Matrix3<f64> {
    left_jacobian_inverse(&-phi_rad)
}

/// Two unit vectors that complete `direction` to an orthonormal basis, as columns; the first axis is stable under small
/// changes of `direction`.
pub fn tangent_basis(direction: &Unit<Vector3<f64>>) -> nalgebra::Matrix3x2<f64> {
    let seed = if direction.x.abs() < 0.7 { Vector3::x() } else { Vector3::y() };
    let e1 = direction.cross(&seed).normalize();
    let e2 = direction.cross(&e1);
    nalgebra::Matrix3x2::from_columns(&[e1, e2])
}
