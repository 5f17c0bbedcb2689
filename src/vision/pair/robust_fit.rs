//! Robust least squares over the matches of a picture pair, for any model that is a 3×3 matrix with derivatives.

use super::normalized_match::Sight;
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

/// How residuals (in units of their σ) count.
#[derive(Debug, Clone, Copy)]
pub(super) enum Loss {
    /// ½c² ln(1 + r²/c²).
    Cauchy(f64),
    /// ½ min(r², c²).
    Truncated(f64),
}

impl Loss {
    /// Cost and weight of a squared residual.
    fn cost_and_weight(self, r2: f64) -> (f64, f64) {
        match self {
            Loss::Cauchy(c) => (0.5 * c * c * (r2 / (c * c)).ln_1p(), 1.0 / (1.0 + r2 / (c * c))),
            Loss::Truncated(c) if r2 < c * c => (0.5 * r2, 1.0),
            Loss::Truncated(c) => (0.5 * c * c, 0.0),
        }
    }
}

/// Normal equations at a model.
#[derive(Debug, Clone, Copy)]
pub(super) struct Normal<const N: usize> {
    pub(super) information: SMatrix<f64, N, N>,
    pub(super) gradient: SVector<f64, N>,
    pub(super) cost: f64,
}

/// Whitened residual of a match; a point that the model puts behind the camera is infinitely far off.
pub(super) fn residual(relation: Relation, matrix: &Matrix3<f64>, sight: &Sight) -> Vector2<f64> {
    match relation {
        Relation::Epipolar => {
            let (left, right) = (matrix.tr_mul(&sight.second_ray()), matrix * sight.first_ray());
            let (g1, g2) = (left.xy(), right.xy());
            let variance = g1.dot(&(sight.from_covariance * g1)) + g2.dot(&(sight.to_covariance * g2));
            let variance = variance + near_epipole(matrix, sight);
            Vector2::new(sight.second_ray().dot(&right) / variance.max(1e-300).sqrt(), 0.0)
        }
        Relation::Transfer => {
            let p = matrix * sight.first_ray();
            if p.z <= 1e-9 {
                return Vector2::new(1e6, 1e6);
            }
            let whitening = transfer_whitening(matrix, sight, &p);
            whitening * (sight.to - p.xy() / p.z)
        }
    }
}

/// Extra variance that stills a point within some tens of σ of an epipole: there the direction of its epipolar line is
/// made of noise, and a fit would steer the epipole by it. (The second-order term of the constraint's error, enlarged.)
fn near_epipole(matrix: &Matrix3<f64>, sight: &Sight) -> f64 {
    const REACH: f64 = 40.0;
    let inner = matrix.fixed_view::<2, 2>(0, 0);
    let mixed = inner * sight.from_covariance * inner.transpose() * sight.to_covariance;
    REACH * REACH * mixed.trace()
}

fn transfer_whitening(matrix: &Matrix3<f64>, sight: &Sight, p: &nalgebra::Vector3<f64>) -> nalgebra::Matrix2<f64> {
    let projection = nalgebra::Matrix2x3::new(1.0, 0.0, -p.x / p.z, 0.0, 1.0, -p.y / p.z) / p.z;
    let by_from = projection * matrix.fixed_columns::<2>(0);
    let covariance = sight.to_covariance + by_from * sight.from_covariance * by_from.transpose();
    super::plane::whitening(&covariance).0
}

/// Residual, its derivative at fixed weights (which makes the information), and the half gradient of its square (which
/// knows that the weights move too; near an epipole that counts, and yet is no information).
pub(super) fn linearized<const N: usize>(
    relation: Relation,
    (matrix, derivatives): &(Matrix3<f64>, [Matrix3<f64>; N]),
    sight: &Sight,
) -> (Vector2<f64>, SMatrix<f64, 2, N>, SVector<f64, N>) {
    let mut jacobian = SMatrix::<f64, 2, N>::zeros();
    let (x1, x2) = (sight.first_ray(), sight.second_ray());
    match relation {
        Relation::Epipolar => {
            let (g1, right) = (matrix.tr_mul(&x2).xy(), matrix * x1);
            let (s1, s2) = (sight.from_covariance * g1, sight.to_covariance * right.xy());
            let variance = (g1.dot(&s1) + right.xy().dot(&s2) + near_epipole(matrix, sight)).max(1e-300);
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
            let r = residual(relation, matrix, sight);
            let p = matrix * x1;
            if p.z <= 1e-9 {
                return (r, jacobian, SVector::zeros());
            }
            let whitening = transfer_whitening(matrix, sight, &p);
            for (j, d) in derivatives.iter().enumerate() {
                let dp = d * x1;
                jacobian.set_column(j, &(-(whitening * (dp.xy() - p.xy() * (dp.z / p.z)) / p.z)));
            }
            (r, jacobian, jacobian.tr_mul(&r))
        }
    }
}

/// Normal equations of all matches at a model.
pub(super) fn normal_equations<const N: usize, M: PairModel<N>>(model: &M, sights: &[Sight], loss: Loss) -> Normal<N> {
    let linear = model.matrix();
    let mut normal = Normal { information: SMatrix::zeros(), gradient: SVector::zeros(), cost: 0.0 };
    for sight in sights {
        let (r, jacobian, gradient) = linearized(M::RELATION, &linear, sight);
        let (cost, weight) = loss.cost_and_weight(r.norm_squared());
        normal.cost += cost;
        if weight > 0.0 {
            normal.information += jacobian.tr_mul(&jacobian) * weight;
            normal.gradient += gradient * weight;
        }
    }
    normal
}

/// Robust cost of a model.
pub(super) fn cost<const N: usize, M: PairModel<N>>(model: &M, sights: &[Sight], loss: Loss) -> f64 {
    let matrix = model.matrix().0;
    sights.iter().map(|s| loss.cost_and_weight(residual(M::RELATION, &matrix, s).norm_squared()).0).sum()
}

/// Levenberg-Marquardt from `start`; returns the best model and the normal equations there.
pub(super) fn descend<const N: usize, M: PairModel<N>>(
    start: M,
    sights: &[Sight],
    loss: Loss,
    iterations: usize,
) -> (M, Normal<N>) {
    let mut model = start;
    let mut normal = normal_equations(&model, sights, loss);
    let mut damping = 1e-4;
    for _ in 0..iterations {
        let mut damped = normal.information;
        for i in 0..N {
            damped[(i, i)] += damping * normal.information[(i, i)] + 1e-12;
        }
        let Some(step) = damped.cholesky().map(|c| -c.solve(&normal.gradient)) else {
            damping = (damping * 10.0).max(1e-4);
            continue;
        };
        let candidate = model.moved(&step);
        if cost(&candidate, sights, loss) < normal.cost {
            let before = normal.cost;
            model = candidate;
            normal = normal_equations(&model, sights, loss);
            damping *= 0.1;
            if before - normal.cost < 1e-7 * before || step.norm() < 1e-12 {
                break;
            }
        } else {
            damping *= 10.0;
            if damping > 1e6 {
                break;
            }
        }
    }
    (model, normal)
}

/// A model fitted to its inliers, with the noise that it found.
#[derive(Debug, Clone)]
pub(super) struct PairFit<const N: usize, M> {
    pub(super) model: M,
    /// Covariance of the parameters; `None` where the matches do not determine them.
    pub(super) covariance: Option<SMatrix<f64, N, N>>,
    /// Which matches agree.
    pub(super) inliers: Vec<bool>,
    /// Actual noise over nominal noise.
    pub(super) scale: f64,
}

impl<const N: usize, M> PairFit<N, M> {
    /// Matches that agree.
    pub(super) fn inlier_count(&self) -> usize {
        self.inliers.iter().filter(|i| **i).count()
    }

    /// The matches that agree.
    pub(super) fn agreeing(&self, sights: &[Sight]) -> Vec<Sight> {
        sights.iter().zip(&self.inliers).filter(|(_, inlier)| **inlier).map(|(s, _)| *s).collect()
    }
}

/// A residual beyond this many σ is an outlier (one, two residuals a match: the tail is below 0.3 %).
fn gate_sigma(relation: Relation) -> f64 {
    if relation == Relation::Epipolar { 3.0 } else { 3.45 }
}

/// Median of |r| over σ, for one and two residuals a match.
fn median_ratio(relation: Relation) -> f64 {
    if relation == Relation::Epipolar { 0.6745 } else { 1.1774 }
}

/// Refines `start` on the matches that agree with it, estimating their noise on the way: Cauchy, then least squares on
/// the inliers.
pub(super) fn fit<const N: usize, M: PairModel<N>>(start: M, sights: &[Sight], widest: f64) -> PairFit<N, M> {
    let mut model = start;
    let mut scale = robust_scale::<N, M>(&model, sights, widest);
    for round in 0..5 {
        let loss = match round {
            0 => Loss::Cauchy(1.5 * scale),
            _ => Loss::Truncated(gate_sigma(M::RELATION) * scale),
        };
        model = descend(model, sights, loss, 12).0;
        let next = robust_scale::<N, M>(&model, sights, gate_sigma(M::RELATION) * scale * 1.2);
        let settled = round >= 2 && (next / scale - 1.0).abs() < 0.02;
        scale = next;
        if settled {
            break;
        }
    }
    finish(model, sights, scale)
}

/// The residuals' robust standard deviation in units of their nominal σ, over those below `widest`.
pub(super) fn robust_scale<const N: usize, M: PairModel<N>>(model: &M, sights: &[Sight], widest: f64) -> f64 {
    let matrix = model.matrix().0;
    let mut sizes: Vec<f64> =
        sights.iter().map(|s| residual(M::RELATION, &matrix, s).norm()).filter(|r| *r < widest).collect();
    if sizes.len() < 8 {
        return widest / gate_sigma(M::RELATION);
    }
    let middle = sizes.len() / 2;
    let median = *sizes.select_nth_unstable_by(middle, f64::total_cmp).1;
    (median / median_ratio(M::RELATION)).clamp(0.03, widest / gate_sigma(M::RELATION))
}

/// Second derivative of the cost, by differences of its gradient.
///
/// The product of Jacobians will not do: the noise of a pixel along its epipolar line looks like parallax, that is, like
/// information (Kanatani 1996, the bias of the moment matrix). The second derivative knows better.
pub(super) fn observed_information<const N: usize, M: PairModel<N>>(
    model: &M,
    sights: &[Sight],
    loss: Loss,
) -> SMatrix<f64, N, N> {
    const STEP: f64 = 1e-6;
    let mut information = SMatrix::<f64, N, N>::zeros();
    for j in 0..N {
        let mut step = SVector::<f64, N>::zeros();
        step[j] = STEP;
        let ahead = normal_equations(&model.moved(&step), sights, loss).gradient;
        let behind = normal_equations(&model.moved(&-step), sights, loss).gradient;
        information.set_column(j, &((ahead - behind) / (2.0 * STEP)));
    }
    (information + information.transpose()) * 0.5
}

fn finish<const N: usize, M: PairModel<N>>(model: M, sights: &[Sight], scale: f64) -> PairFit<N, M> {
    let gate = gate_sigma(M::RELATION) * scale;
    let matrix = model.matrix().0;
    let inliers: Vec<bool> = sights.iter().map(|s| residual(M::RELATION, &matrix, s).norm() < gate).collect();
    let agreeing: Vec<Sight> = sights.iter().zip(&inliers).filter(|(_, inlier)| **inlier).map(|(s, _)| *s).collect();
    let information = observed_information(&model, &agreeing, Loss::Truncated(f64::INFINITY));
    let rows = if M::RELATION == Relation::Epipolar { 1 } else { 2 };
    let inside: f64 = agreeing.iter().map(|s| residual(M::RELATION, &matrix, s).norm_squared()).sum();
    let freedom = (agreeing.len() * rows) as f64 - N as f64;
    let variance = if freedom > 0.0 { inside / freedom } else { f64::INFINITY };
    let covariance = information.cholesky().filter(|_| variance.is_finite()).map(|c| c.inverse() * variance.max(9e-4));
    PairFit { model, covariance, inliers, scale: variance.sqrt().max(0.03) }
}
