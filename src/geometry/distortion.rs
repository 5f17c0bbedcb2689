//! Lens distortion between ideal normalised image coordinates (x/z, y/z) and distorted ones.

use nalgebra::{Matrix2, Vector2};

/// Distortion model with OpenCV's coefficients.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Distortion {
    /// A pinhole camera.
    #[default]
    None,
    /// Brown–Conrady: `[k1, k2, p1, p2]` (Brown 1966; OpenCV's `calib3d`).
    RadialTangential([f64; 4]),
    /// Kannala–Brandt fisheye: `[k1, k2, k3, k4]` on odd powers of the angle off the axis (Kannala and Brandt 2006).
    Equidistant([f64; 4]),
}

impl Distortion {
    /// Distorted coordinates of the ideal point, and the derivative of the one by the other.
    pub fn distort(&self, ideal: &Vector2<f64>) -> (Vector2<f64>, Matrix2<f64>) {
        match self {
            Distortion::None => (*ideal, Matrix2::identity()),
            Distortion::RadialTangential(k) => brown_conrady(ideal, k),
            Distortion::Equidistant(k) => kannala_brandt(ideal, k),
        }
    }

    /// Inverse of [`Distortion::distort`] by Newton's method; `None` where it does not converge (outside the invertible
    /// region).
    pub fn undistort(&self, distorted: &Vector2<f64>) -> Option<Vector2<f64>> {
        match self {
            Distortion::None => Some(*distorted),
            Distortion::RadialTangential(_) => self.undistort_by_newton(distorted),
            Distortion::Equidistant(k) => undistort_kannala_brandt(distorted, k),
        }
    }

    fn undistort_by_newton(&self, distorted: &Vector2<f64>) -> Option<Vector2<f64>> {
        let mut ideal = *distorted;
        for _ in 0..50 {
            let (value, jacobian) = self.distort(&ideal);
            if jacobian.determinant() <= 0.0 {
                return None;
            }
            let step = jacobian.try_inverse()? * (distorted - value);
            ideal += step;
            if step.norm() < 1e-14 * (1.0 + ideal.norm()) {
                return Some(ideal);
            }
        }
        let residual = (distorted - self.distort(&ideal).0).norm();
        (residual < 1e-10).then_some(ideal)
    }
}

fn brown_conrady(p: &Vector2<f64>, k: &[f64; 4]) -> (Vector2<f64>, Matrix2<f64>) {
    let [k1, k2, p1, p2] = *k;
    let (x, y) = (p.x, p.y);
    let r2 = x * x + y * y;
    let radial = 1.0 + r2 * (k1 + r2 * k2);
    let radial_slope = 2.0 * (k1 + 2.0 * k2 * r2); // d(radial)/dx = radial_slope * x
    let value = Vector2::new(
        x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
        y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y,
    );
    let cross = x * y * radial_slope + 2.0 * p1 * x + 2.0 * p2 * y;
    let jacobian = Matrix2::new(
        radial + x * x * radial_slope + 2.0 * p1 * y + 6.0 * p2 * x,
        cross,
        cross,
        radial + y * y * radial_slope + 6.0 * p1 * y + 2.0 * p2 * x,
    );
    (value, jacobian)
}

/// The angle after distortion, and its derivative by the angle before.
fn kannala_brandt_angle(theta_rad: f64, k: &[f64; 4]) -> (f64, f64) {
    let t2 = theta_rad * theta_rad;
    let value = theta_rad * (1.0 + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3]))));
    let slope = 1.0 + t2 * (3.0 * k[0] + t2 * (5.0 * k[1] + t2 * (7.0 * k[2] + t2 * 9.0 * k[3])));
    (value, slope)
}

fn kannala_brandt(p: &Vector2<f64>, k: &[f64; 4]) -> (Vector2<f64>, Matrix2<f64>) {
    let r = p.norm();
    if r < 1e-9 {
        return (*p, Matrix2::identity());
    }
    let (angle, slope) = kannala_brandt_angle(r.atan(), k);
    let scale = angle / r;
    let d_angle_d_r = slope / (1.0 + r * r);
    let n = p / r;
    let along = n * n.transpose();
    (p * scale, along * d_angle_d_r + (Matrix2::identity() - along) * scale)
}

fn undistort_kannala_brandt(distorted: &Vector2<f64>, k: &[f64; 4]) -> Option<Vector2<f64>> {
    let radius = distorted.norm();
    if radius < 1e-12 {
        return Some(*distorted);
    }
    let mut theta = radius.min(std::f64::consts::FRAC_PI_2);
    for _ in 0..50 {
        let (value, slope) = kannala_brandt_angle(theta, k);
        if slope <= 0.0 {
            return None;
        }
        let step = (radius - value) / slope;
        theta += step;
        if step.abs() < 1e-15 * (1.0 + theta) {
            break;
        }
    }
    let converged = (kannala_brandt_angle(theta, k).0 - radius).abs() < 1e-10;
    let ahead = theta > 0.0 && theta < std::f64::consts::FRAC_PI_2;
    (converged && ahead).then(|| distorted * (theta.tan() / radius))
}
