//! Errors that vary smoothly over the picture, as unknowns of their own.
//!
//! The looks of a surface change with the view and the light, and they change alike all over the picture or a good part
//! of it. Patches and corners follow. No number of matches averages such an error out, and a motion is easily bent to it:
//! at low orders, a change of rotation looks the same. So the error of a match, in units of its noise, is a polynomial of
//! its place with normal coefficients, besides white noise. The polynomial is eliminated from the normal equations of the
//! motion (Schur complement), which leaves the motion to what a smooth error cannot imitate.
//!
//! The coefficients' variance, as a share of the noise's, is the most likely one of the pair (restricted likelihood,
//! Patterson and Thompson 1971), held near what pictures rendered with known motion show.

use super::clusters::{cells, covariance_of_rotation};
use super::pair_fit::{Loss, PairFit, PairModel, Relation, linearized, observed_information, residual};
use super::sight::Sight;
use nalgebra::{Matrix2, Matrix3, SMatrix, SVector, Vector2};

/// Polynomials up to the third order.
const MODES: usize = 10;
/// The first modes, up to the second order; the others have half the variance.
const LOW_MODES: usize = 6;
/// Coefficients of the error, two components a mode.
pub(super) const COEFFICIENTS: usize = 2 * MODES;
/// Width of the logarithm of the share about what is expected.
const SHARE_WIDTH: f64 = 0.7;

/// The share of the noise's variance that the coefficients have, at least: nothing is perfectly white.
const LEAST_SHARE: f64 = 1e-9;

/// A motion refined with the smooth error as an unknown.
pub(super) struct Refined<M> {
    pub(super) model: M,
    /// Covariance (rad²) of its rotation.
    pub(super) rotation_covariance_rad2: Matrix3<f64>,
}

/// Refines a fit on the matches that agree with it, its smooth error eliminated; `None` where that leaves it undetermined.
/// `share` is the expected one.
pub(super) fn refine<const N: usize, M: PairModel<N>>(
    fit: &PairFit<N, M>,
    sights: &[Sight],
    share: f64,
) -> Option<Refined<M>> {
    let inside = fit.agreeing(sights);
    let places = Places::of(&inside);
    let mut sums = Sums::of(&fit.model, &inside, (&places, fit.scale));
    let share = sums.likeliest_share(share.max(LEAST_SHARE));
    let mut model = fit.model;
    for _ in 0..2 {
        model = model.moved(&sums.eliminated(share)?.step()?);
        sums = Sums::of(&model, &inside, (&places, fit.scale));
    }
    let left = sums.eliminated(share)?;
    // The product of Jacobians takes noise for parallax; by how much, the second derivative knows.
    let observed = observed_information(&model, &inside, Loss::Truncated(f64::INFINITY)) / fit.scale.powi(2);
    let bias = observed.cholesky()?.inverse() - sums.motion.cholesky()?.inverse();
    let covariance = left.information.cholesky()?.inverse() + bias;
    covariance.cholesky()?;
    let scores = left.scores(&model, &inside, (&places, fit.scale));
    let rotation_covariance_rad2 = covariance_of_rotation(&covariance, &scores, &cells(&inside))?;
    Some(Refined { model, rotation_covariance_rad2 })
}

/// What a pair says about a motion as if all errors were white: the information, the gradient, and how that gradient moves
/// with the coefficients of the smooth error.
pub(super) struct White<const N: usize> {
    pub(super) information: SMatrix<f64, N, N>,
    pub(super) gradient: SVector<f64, N>,
    pub(super) by_smooth_error: SMatrix<f64, N, COEFFICIENTS>,
}

impl<const N: usize> White<N> {
    /// Over the matches within 3σ, `scale` being the noise over the nominal one.
    pub(super) fn of<M: PairModel<N>>(model: &M, sights: &[Sight], scale: f64) -> Self {
        let matrix = model.matrix().0;
        let near = |s: &&Sight| residual(M::RELATION, &matrix, s).norm() < 3.0 * scale;
        let inside: Vec<Sight> = sights.iter().filter(near).copied().collect();
        let sums = Sums::of(model, &inside, (&Places::of(&inside), scale));
        White { information: sums.motion, gradient: sums.motion_gradient, by_smooth_error: sums.mixed }
    }
}

/// Covariance of a gradient that moves so with the coefficients of a smooth error.
pub(super) fn spread<const N: usize>(
    by_smooth_error: &SMatrix<f64, N, COEFFICIENTS>,
    share: f64,
) -> SMatrix<f64, N, N> {
    let columns = by_smooth_error.column_iter().enumerate();
    columns.fold(SMatrix::zeros(), |sum, (i, column)| sum + column * column.transpose() * variance(i, share))
}

/// Variance of a coefficient over that of the noise.
fn variance(coefficient: usize, share: f64) -> f64 {
    if coefficient % MODES < LOW_MODES { share } else { 0.5 * share }
}

/// Where the matches lie in the first picture.
struct Places {
    center: Vector2<f64>,
    spread: f64,
}

impl Places {
    fn of(sights: &[Sight]) -> Self {
        let count = sights.len().max(1) as f64;
        let center = sights.iter().map(|s| s.from).sum::<Vector2<f64>>() / count;
        let square = sights.iter().map(|s| (s.from - center).norm_squared()).sum::<f64>() / (2.0 * count);
        Places { center, spread: square.sqrt().max(1e-9) }
    }

    /// The polynomials at a match, each of a mean square near 1 over an even picture.
    fn modes(&self, sight: &Sight) -> [f64; MODES] {
        const H: f64 = std::f64::consts::FRAC_1_SQRT_2;
        let p = (sight.from - self.center) / self.spread;
        let (x2, y2) = (p.x * p.x, p.y * p.y);
        let second = [p.x * p.y, H * (x2 - 1.0), H * (y2 - 1.0)];
        let third = [p.x * (x2 - 1.8), p.y * (y2 - 1.8), p.x * (y2 - 1.0), p.y * (x2 - 1.0)].map(|m| 0.5 * m);
        let [a, b, c] = second;
        let [d, e, f, g] = third;
        [1.0, p.x, p.y, a, b, c, d, e, f, g]
    }

    /// Derivative of a match's whitened residual by the coefficients.
    fn by_coefficients(&self, matrix: &Matrix3<f64>, sight: &Sight) -> SVector<f64, COEFFICIENTS> {
        let (left, right) = (matrix.tr_mul(&sight.second_ray()).xy(), (matrix * sight.first_ray()).xy());
        let variance = left.dot(&(sight.from_covariance * left)) + right.dot(&(sight.to_covariance * right));
        let one = sight.to_covariance.cholesky().map_or_else(Matrix2::zeros, |c| c.l());
        // Both pixels err: the error of one against the other has twice the variance of either.
        let by_error = one.tr_mul(&right) * std::f64::consts::SQRT_2 / variance.max(1e-300).sqrt();
        let modes = self.modes(sight);
        SVector::from_fn(|i, _| by_error[i / MODES] * modes[i % MODES])
    }
}

/// Normal equations of a motion and the coefficients of its smooth error, in units of the noise.
struct Sums<const N: usize> {
    motion: SMatrix<f64, N, N>,
    mixed: SMatrix<f64, N, COEFFICIENTS>,
    coefficients: SMatrix<f64, COEFFICIENTS, COEFFICIENTS>,
    motion_gradient: SVector<f64, N>,
    coefficients_gradient: SVector<f64, COEFFICIENTS>,
}

impl<const N: usize> Sums<N> {
    fn of<M: PairModel<N>>(model: &M, sights: &[Sight], (places, scale): (&Places, f64)) -> Self {
        debug_assert!(M::RELATION == Relation::Epipolar);
        let linear = model.matrix();
        let mut sums = Sums {
            motion: SMatrix::zeros(),
            mixed: SMatrix::zeros(),
            coefficients: SMatrix::zeros(),
            motion_gradient: SVector::zeros(),
            coefficients_gradient: SVector::zeros(),
        };
        for sight in sights {
            let (r, jacobian, gradient) = linearized(M::RELATION, &linear, sight);
            let j: SVector<f64, N> = jacobian.row(0).transpose() / scale;
            let g = places.by_coefficients(&linear.0, sight);
            sums.motion += j * j.transpose();
            sums.mixed += j * g.transpose();
            sums.coefficients += g * g.transpose();
            sums.motion_gradient += gradient / scale.powi(2);
            sums.coefficients_gradient += g * (r.x / scale);
        }
        sums
    }

    /// The motion's equations once the coefficients, of variance `share`, are eliminated.
    fn eliminated(&self, share: f64) -> Option<Eliminated<N>> {
        let mut information = self.coefficients;
        let mut ln_determinant = 0.0;
        for i in 0..COEFFICIENTS {
            information[(i, i)] += 1.0 / variance(i, share);
            ln_determinant += variance(i, share).ln();
        }
        let factor = information.cholesky()?;
        let gain = factor.solve(&self.mixed.transpose());
        let error = -factor.solve(&self.coefficients_gradient);
        let ln_diagonal = |l: f64| 2.0 * l.ln();
        Some(Eliminated {
            information: self.motion - self.mixed * gain,
            gradient: self.motion_gradient - gain.tr_mul(&self.coefficients_gradient),
            gain,
            error,
            cost: self.coefficients_gradient.dot(&error)
                + ln_determinant
                + factor.l_dirty().diagonal().map(ln_diagonal).sum(),
        })
    }

    /// The share with the greatest restricted likelihood, the expected one being likely beforehand.
    fn likeliest_share(&self, expected: f64) -> f64 {
        const STEPS: i32 = 4;
        let ln_step = 0.5 * SHARE_WIDTH;
        let cost = |k: i32| {
            let share = expected * (f64::from(k) * ln_step).exp();
            let left = self.eliminated(share)?;
            let step = left.step()?;
            let information = left.information.cholesky()?;
            let ln_determinant = information.l_dirty().diagonal().map(|l| 2.0 * l.ln()).sum();
            Some(left.cost + left.gradient.dot(&step) + ln_determinant + (f64::from(k) * 0.5).powi(2))
        };
        let costs = (-STEPS..=STEPS).filter_map(|k| cost(k).map(|c| (k, c)));
        let best = costs.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |b| b.0);
        expected * (f64::from(best) * ln_step).exp()
    }
}

/// A motion's normal equations without the coefficients.
struct Eliminated<const N: usize> {
    information: SMatrix<f64, N, N>,
    gradient: SVector<f64, N>,
    /// How the coefficients follow the motion.
    gain: SMatrix<f64, COEFFICIENTS, N>,
    /// The likeliest coefficients at this motion, with the sign of a correction to the residuals.
    error: SVector<f64, COEFFICIENTS>,
    /// `-2 ln` of the likelihood, what the motion adds and what does not depend on the share left out.
    cost: f64,
}

impl<const N: usize> Eliminated<N> {
    fn step(&self) -> Option<SVector<f64, N>> {
        self.information.cholesky().map(|c| -c.solve(&self.gradient))
    }

    /// Scores of the matches once the smooth error is taken off them.
    fn scores<M: PairModel<N>>(
        &self,
        model: &M,
        sights: &[Sight],
        (places, scale): (&Places, f64),
    ) -> Vec<SVector<f64, N>> {
        let linear = model.matrix();
        let score = |sight: &Sight| {
            let (r, jacobian, gradient) = linearized(M::RELATION, &linear, sight);
            let j: SVector<f64, N> = jacobian.row(0).transpose() / scale;
            let g = places.by_coefficients(&linear.0, sight);
            let taken = self.gain.tr_mul(&g);
            gradient / scale.powi(2) - taken * (r.x / scale) + (j - taken) * g.dot(&self.error)
        };
        sights.iter().map(score).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::so3::exp;
    use crate::vision::pair_models::General;
    use nalgebra::{Unit, Vector3};

    fn model() -> General {
        let rotation = exp(&Vector3::new(0.02, -0.015, 0.1));
        General { rotation, direction: Unit::new_normalize(Vector3::new(0.4, -0.2, 1.0)) }
    }

    /// Points at several depths, seen without noise.
    fn sights() -> Vec<Sight> {
        let from_covariance = Matrix2::new(4.0, 1.0, 1.0, 2.0) * 1e-8;
        let to_covariance = Matrix2::new(3.0, -1.0, -1.0, 5.0) * 1e-8;
        let place = |k: usize| Vector2::new(0.11 * (k % 5) as f64 - 0.2, 0.07 * (k / 5) as f64 - 0.25);
        let sight = |k: usize| {
            let inverse_depth = 0.02 * (1.0 + 0.3 * (k % 3) as f64);
            let p = model().rotation * place(k).push(1.0) + model().direction.into_inner() * inverse_depth;
            Sight { from: place(k), to: p.xy() / p.z, from_covariance, to_covariance }
        };
        (0..40).map(sight).collect()
    }

    /// Greatest difference between the derivatives by the coefficients and those by differences of the residual, over the
    /// greatest of them, where a coefficient of 1 moves the second point by its noise against the first times `size`.
    fn off(size: f64) -> f64 {
        const STEP: f64 = 1e-3;
        let (matrix, _) = model().matrix();
        let (all, mut worst, mut greatest) = (sights(), 0.0f64, 0.0f64);
        let places = Places::of(&all);
        for sight in &all {
            let by = places.by_coefficients(&matrix, sight);
            let factor = sight.to_covariance.cholesky().expect("positive").l() * std::f64::consts::SQRT_2 * size;
            for i in 0..COEFFICIENTS {
                let error = factor.column(i / MODES) * places.modes(sight)[i % MODES] * STEP;
                let at = |to: Vector2<f64>| residual(Relation::Epipolar, &matrix, &Sight { to, ..*sight }).x;
                let numeric = (at(sight.to + error) - at(sight.to - error)) / (2.0 * STEP);
                (worst, greatest) = (worst.max((numeric - by[i]).abs()), greatest.max(by[i].abs()));
            }
        }
        worst / greatest
    }

    #[test]
    fn the_derivative_by_a_coefficient_is_that_of_the_residual() {
        assert!(off(1.0) < 5e-3, "{}", off(1.0));
        assert!(off(1.1) > 0.05, "an error larger by a tenth is noticed: {}", off(1.1));
    }

    #[test]
    fn a_smooth_error_takes_information_away_and_more_with_its_share() {
        let all = sights();
        let sums = Sums::of(&model(), &all, (&Places::of(&all), 1.0));
        let left = |share: f64| sums.eliminated(share).expect("positive").information;
        let least = |m: SMatrix<f64, 5, 5>| m.symmetric_eigenvalues().min() / sums.motion.trace();
        assert!(least(sums.motion - left(0.01)) > -1e-9 && least(left(0.01) - left(0.1)) > -1e-9);
        assert!((left(1e-12) - sums.motion).norm() < 1e-6 * sums.motion.norm());
        assert!((left(0.1) - sums.motion).norm() > 1e-3 * sums.motion.norm());
    }
}
