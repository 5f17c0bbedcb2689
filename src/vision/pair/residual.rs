//! Residuals of matches under a relation between two images.

use super::normalized_match::NormalizedMatch;
use nalgebra::{Matrix3, SMatrix, SVector, Vector2};

/// What a model's matrix means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Relation {
    /// `to · M from = 0`: one residual, the Sampson error.
    Epipolar,
    /// `to ∝ M from`: two residuals, the transfer error.
    Transfer,
}

/// A two-view model with `N` free parameters.
pub(super) trait PairModel<const N: usize>: Copy {
    /// What the matrix means.
    const RELATION: Relation;
    /// The matrix, and its derivative by each parameter.
    fn matrix(&self) -> (Matrix3<f64>, [Matrix3<f64>; N]);
    /// The model moved along its parameters.
    fn moved(&self, step: &SVector<f64, N>) -> Self;
}

/// Whitened residual of a match; a point that the model puts behind the camera is infinitely far off.
pub(super) fn residual(relation: Relation, matrix: &Matrix3<f64>, matched: &NormalizedMatch) -> Vector2<f64> {
    match relation {
        Relation::Epipolar => {
            let (left, right) = (matrix.tr_mul(&matched.second_ray()), matrix * matched.first_ray());
            let (g1, g2) = (left.xy(), right.xy());
            let variance = g1.dot(&(matched.from_covariance * g1)) + g2.dot(&(matched.to_covariance * g2));
            let variance = variance + near_epipole(matrix, matched);
            Vector2::new(matched.second_ray().dot(&right) / variance.max(1e-300).sqrt(), 0.0)
        }
        Relation::Transfer => {
            let p = matrix * matched.first_ray();
            if p.z <= 1e-9 {
                return Vector2::new(1e6, 1e6);
            }
            let whitening = transfer_whitening(matrix, matched, &p);
            whitening * (matched.to - p.xy() / p.z)
        }
    }
}

/// Extra variance that stills a point within some tens of σ of an epipole: there the direction of its epipolar line is
/// made of noise, and a fit would steer the epipole by it. (The second-order term of the constraint's error, enlarged.)
fn near_epipole(matrix: &Matrix3<f64>, matched: &NormalizedMatch) -> f64 {
    // A guard, chosen wide: it weighs down the few points about an epipole and says nothing of the noise elsewhere.
    const REACH: f64 = 40.0;
    let inner = matrix.fixed_view::<2, 2>(0, 0);
    let mixed = inner * matched.from_covariance * inner.transpose() * matched.to_covariance;
    REACH * REACH * mixed.trace()
}

fn transfer_whitening(
    matrix: &Matrix3<f64>,
    matched: &NormalizedMatch,
    p: &nalgebra::Vector3<f64>,
) -> nalgebra::Matrix2<f64> {
    let projection = nalgebra::Matrix2x3::new(1.0, 0.0, -p.x / p.z, 0.0, 1.0, -p.y / p.z) / p.z;
    let by_from = projection * matrix.fixed_columns::<2>(0);
    let covariance = matched.to_covariance + by_from * matched.from_covariance * by_from.transpose();
    super::plane::whitening(&covariance).0
}

/// Residual, its derivative at fixed weights (which makes the information), and the half gradient of its square (which
/// knows that the weights move too; near an epipole that counts, and yet is no information).
pub(super) fn linearized<const N: usize>(
    relation: Relation,
    (matrix, derivatives): &(Matrix3<f64>, [Matrix3<f64>; N]),
    matched: &NormalizedMatch,
) -> (Vector2<f64>, SMatrix<f64, 2, N>, SVector<f64, N>) {
    let mut jacobian = SMatrix::<f64, 2, N>::zeros();
    let (x1, x2) = (matched.first_ray(), matched.second_ray());
    match relation {
        Relation::Epipolar => {
            let (g1, right) = (matrix.tr_mul(&x2).xy(), matrix * x1);
            let (s1, s2) = (matched.from_covariance * g1, matched.to_covariance * right.xy());
            let variance = (g1.dot(&s1) + right.xy().dot(&s2) + near_epipole(matrix, matched)).max(1e-300);
            let deviation = variance.sqrt();
            let r = x2.dot(&right) / deviation;
            let mut gradient = SVector::zeros();
            for (j, d) in derivatives.iter().enumerate() {
                let d_right = d * x1;
                let d_variance = 2.0 * (s1.dot(&d.tr_mul(&x2).xy()) + s2.dot(&d_right.xy()));
                jacobian[(0, j)] = x2.dot(&d_right) / deviation;
                gradient[j] = r * (jacobian[(0, j)] - 0.5 * r * d_variance / variance);
            }
            (Vector2::new(r, 0.0), jacobian, gradient)
        }
        Relation::Transfer => {
            let r = residual(relation, matrix, matched);
            let p = matrix * x1;
            if p.z <= 1e-9 {
                return (r, jacobian, SVector::zeros());
            }
            let whitening = transfer_whitening(matrix, matched, &p);
            for (j, d) in derivatives.iter().enumerate() {
                let dp = d * x1;
                jacobian.set_column(j, &(-(whitening * (dp.xy() - p.xy() * (dp.z / p.z)) / p.z)));
            }
            (r, jacobian, jacobian.tr_mul(&r))
        }
    }
}
