//! Robust least squares over the matches of an image pair, for any model that is a 3×3 matrix with derivatives.

use super::normalized_match::NormalizedMatch;
use super::residual::{PairModel, Relation, linearized, residual};
use crate::stats::{
    Damping, LeastSquares, LeastSquaresOptions, Minimum, NORMAL_MEDIAN, NORMAL_MEDIAN_2D, NormalEquations, Steps,
    minimize, symmetric, upper_median,
};
use nalgebra::{Const, SMatrix, SVector};
use std::marker::PhantomData;

const DAMPING: Damping = Damping { start: 1e-4, raise: 10.0, lower: 0.1, least: 0.0, most: 1e6, takes_level: false };

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

/// Normal equations of all matches at a model.
pub(super) fn normal_equations<const N: usize, M: PairModel<N>>(
    model: &M,
    normalized: &[NormalizedMatch],
    loss: Loss,
) -> NormalEquations<Const<N>> {
    let linear = model.matrix();
    let mut normal = NormalEquations { information: SMatrix::zeros(), right_side: SVector::zeros(), cost: 0.0 };
    for matched in normalized {
        let (r, jacobian, gradient) = linearized(M::RELATION, &linear, matched);
        let (cost, weight) = loss.cost_and_weight(r.norm_squared());
        normal.cost += cost;
        if weight > 0.0 {
            normal.information += jacobian.tr_mul(&jacobian) * weight;
            normal.right_side -= gradient * weight;
        }
    }
    normal
}

/// Robust cost of a model.
pub(super) fn cost<const N: usize, M: PairModel<N>>(model: &M, normalized: &[NormalizedMatch], loss: Loss) -> f64 {
    let matrix = model.matrix().0;
    normalized.iter().map(|s| loss.cost_and_weight(residual(M::RELATION, &matrix, s).norm_squared()).0).sum()
}

/// Matches that pull at a model.
struct Pull<'a, const N: usize, M> {
    normalized: &'a [NormalizedMatch],
    loss: Loss,
    model: PhantomData<M>,
}

impl<const N: usize, M: PairModel<N>> LeastSquares for Pull<'_, N, M> {
    type Size = Const<N>;
    type State = M;

    fn normal_equations(&self, model: &M) -> NormalEquations<Const<N>> {
        normal_equations(model, self.normalized, self.loss)
    }

    fn cost(&self, model: &M) -> f64 {
        cost(model, self.normalized, self.loss)
    }

    fn moved(&self, model: &M, step: &SVector<f64, N>) -> Option<M> {
        Some(model.moved(step))
    }

    fn damp(&self, _model: &M, information: &mut SMatrix<f64, N, N>, damping: f64) {
        for i in 0..N {
            information[(i, i)] += damping * information[(i, i)] + 1e-12;
        }
    }
}

/// Levenberg-Marquardt from `start`.
pub(super) fn descend<const N: usize, M: PairModel<N>>(
    start: M,
    normalized: &[NormalizedMatch],
    loss: Loss,
    iterations: usize,
) -> Minimum<M, Const<N>> {
    let options = LeastSquaresOptions {
        steps: Steps::Damped(DAMPING),
        most_steps: iterations,
        least_step: 1e-12,
        least_drop_share: 1e-7,
        least_drop: 0.0,
    };
    minimize(&Pull { normalized, loss, model: PhantomData }, start, &options)
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
    pub(super) fn agreeing(&self, normalized: &[NormalizedMatch]) -> Vec<NormalizedMatch> {
        normalized.iter().zip(&self.inliers).filter(|(_, inlier)| **inlier).map(|(s, _)| *s).collect()
    }
}

/// A residual beyond this many σ is an outlier (one, two residuals a match: the tail is below 0.3 %).
fn gate_sigma(relation: Relation) -> f64 {
    if relation == Relation::Epipolar { 3.0 } else { 3.45 }
}

/// Median of |r| over σ, for one and two residuals a match.
fn median_ratio(relation: Relation) -> f64 {
    if relation == Relation::Epipolar { NORMAL_MEDIAN } else { NORMAL_MEDIAN_2D }
}

/// Refines `start` on the matches that agree with it, estimating their noise on the way: Cauchy, then least squares on
/// the inliers.
pub(super) fn fit<const N: usize, M: PairModel<N>>(
    start: M,
    normalized: &[NormalizedMatch],
    widest: f64,
) -> PairFit<N, M> {
    let mut model = start;
    let mut scale = robust_scale::<N, M>(&model, normalized, widest);
    for round in 0..5 {
        let loss = match round {
            0 => Loss::Cauchy(1.5 * scale),
            _ => Loss::Truncated(gate_sigma(M::RELATION) * scale),
        };
        model = descend(model, normalized, loss, 12).state;
        let next = robust_scale::<N, M>(&model, normalized, gate_sigma(M::RELATION) * scale * 1.2);
        let settled = round >= 2 && (next / scale - 1.0).abs() < 0.02;
        scale = next;
        if settled {
            break;
        }
    }
    finish(model, normalized, scale)
}

/// The residuals' robust standard deviation in units of their nominal σ, over those below `widest`.
pub(super) fn robust_scale<const N: usize, M: PairModel<N>>(
    model: &M,
    normalized: &[NormalizedMatch],
    widest: f64,
) -> f64 {
    let matrix = model.matrix().0;
    let mut sizes: Vec<f64> =
        normalized.iter().map(|s| residual(M::RELATION, &matrix, s).norm()).filter(|r| *r < widest).collect();
    if sizes.len() < 8 {
        return widest / gate_sigma(M::RELATION);
    }
    let median = upper_median(&mut sizes).expect("eight at least");
    (median / median_ratio(M::RELATION)).clamp(0.03, widest / gate_sigma(M::RELATION))
}

/// Second derivative of the cost, by differences of its gradient.
///
/// The product of Jacobians will not do: the noise of a pixel along its epipolar line looks like parallax, that is, like
/// information (Kanatani 1996, the bias of the moment matrix). The second derivative knows better.
pub(super) fn observed_information<const N: usize, M: PairModel<N>>(
    model: &M,
    normalized: &[NormalizedMatch],
    loss: Loss,
) -> SMatrix<f64, N, N> {
    const STEP: f64 = 1e-6;
    let mut information = SMatrix::<f64, N, N>::zeros();
    for j in 0..N {
        let mut step = SVector::<f64, N>::zeros();
        step[j] = STEP;
        let ahead = normal_equations(&model.moved(&step), normalized, loss).right_side;
        let behind = normal_equations(&model.moved(&-step), normalized, loss).right_side;
        information.set_column(j, &((behind - ahead) / (2.0 * STEP)));
    }
    symmetric(&information)
}

fn finish<const N: usize, M: PairModel<N>>(model: M, normalized: &[NormalizedMatch], scale: f64) -> PairFit<N, M> {
    let gate = gate_sigma(M::RELATION) * scale;
    let matrix = model.matrix().0;
    let inliers: Vec<bool> = normalized.iter().map(|s| residual(M::RELATION, &matrix, s).norm() < gate).collect();
    let agreeing: Vec<NormalizedMatch> =
        normalized.iter().zip(&inliers).filter(|(_, inlier)| **inlier).map(|(s, _)| *s).collect();
    let information = observed_information(&model, &agreeing, Loss::Truncated(f64::INFINITY));
    let rows = if M::RELATION == Relation::Epipolar { 1 } else { 2 };
    let inside: f64 = agreeing.iter().map(|s| residual(M::RELATION, &matrix, s).norm_squared()).sum();
    let freedom = (agreeing.len() * rows) as f64 - N as f64;
    let variance = if freedom > 0.0 { inside / freedom } else { f64::INFINITY };
    let covariance = information.cholesky().filter(|_| variance.is_finite()).map(|c| c.inverse() * variance.max(9e-4));
    PairFit { model, covariance, inliers, scale: variance.sqrt().max(0.03) }
}
