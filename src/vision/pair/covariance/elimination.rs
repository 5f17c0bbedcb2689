//! Normal equations of a motion with the coefficients of a smooth error, and what is left once those are eliminated.

use super::correlated_modes::{COEFFICIENTS, Places, variance};
use crate::vision::pair::normalized_match::NormalizedMatch;
use crate::vision::pair::residual::{PairModel, Relation, linearized};
use nalgebra::{SMatrix, SVector};

/// Width of the logarithm of the share about what is expected.
const SHARE_WIDTH: f64 = 0.7;

/// Covariance of a gradient that moves so with the coefficients of a smooth error.
pub fn spread<const N: usize>(by_correlated_error: &SMatrix<f64, N, COEFFICIENTS>, share: f64) -> SMatrix<f64, N, N> {
    let columns = by_correlated_error.column_iter().enumerate();
    columns.fold(SMatrix::zeros(), |sum, (i, column)| sum + column * column.transpose() * variance(i, share))
}

/// Normal equations of a motion and the coefficients of its smooth error, in units of the noise.
pub(super) struct Sums<const N: usize> {
    pub(super) motion: SMatrix<f64, N, N>,
    pub(super) mixed: SMatrix<f64, N, COEFFICIENTS>,
    coefficients: SMatrix<f64, COEFFICIENTS, COEFFICIENTS>,
    pub(super) motion_gradient: SVector<f64, N>,
    coefficients_gradient: SVector<f64, COEFFICIENTS>,
}

impl<const N: usize> Sums<N> {
    pub(super) fn of<M: PairModel<N>>(
        model: &M,
        normalized: &[NormalizedMatch],
        (places, scale): (&Places, f64),
    ) -> Self {
        debug_assert!(M::RELATION == Relation::Epipolar);
        let linear = model.matrix();
        let mut sums = Sums {
            motion: SMatrix::zeros(),
            mixed: SMatrix::zeros(),
            coefficients: SMatrix::zeros(),
            motion_gradient: SVector::zeros(),
            coefficients_gradient: SVector::zeros(),
        };
        for matched in normalized {
            let (r, jacobian, gradient) = linearized(M::RELATION, &linear, matched);
            let j: SVector<f64, N> = jacobian.row(0).transpose() / scale;
            let g = places.by_coefficients(&linear.0, matched);
            sums.motion += j * j.transpose();
            sums.mixed += j * g.transpose();
            sums.coefficients += g * g.transpose();
            sums.motion_gradient += gradient / scale.powi(2);
            sums.coefficients_gradient += g * (r.x / scale);
        }
        sums
    }

    /// The motion's equations once the coefficients, of variance `share`, are eliminated.
    pub(super) fn eliminated(&self, share: f64) -> Option<Eliminated<N>> {
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

    /// Covariance of the motion that was found with the coefficients eliminated, where their variance is truly `share`.
    pub(super) fn covariance(&self, left: &Eliminated<N>, share: f64) -> Option<SMatrix<f64, N, N>> {
        let by_correlated_error = self.mixed - left.gain.tr_mul(&self.coefficients);
        let crossed = self.mixed * left.gain;
        let white = self.motion - crossed - crossed.transpose() + left.gain.tr_mul(&self.coefficients) * left.gain;
        let inverse = left.information.cholesky()?.inverse();
        Some(inverse * (white + spread(&by_correlated_error, share)) * inverse)
    }

    /// The share with the greatest restricted likelihood, the expected one being likely beforehand.
    pub(super) fn likeliest_share(&self, expected: f64) -> f64 {
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
pub(super) struct Eliminated<const N: usize> {
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
    pub(super) fn step(&self) -> Option<SVector<f64, N>> {
        self.information.cholesky().map(|c| -c.solve(&self.gradient))
    }

    /// Scores of the matches once the smooth error is taken off them.
    pub(super) fn scores<M: PairModel<N>>(
        &self,
        model: &M,
        normalized: &[NormalizedMatch],
        (places, scale): (&Places, f64),
    ) -> Vec<SVector<f64, N>> {
        let linear = model.matrix();
        let score = |matched: &NormalizedMatch| {
            let (r, jacobian, gradient) = linearized(M::RELATION, &linear, matched);
            let j: SVector<f64, N> = jacobian.row(0).transpose() / scale;
            let g = places.by_coefficients(&linear.0, matched);
            let taken = self.gain.tr_mul(&g);
            gradient / scale.powi(2) - taken * (r.x / scale) + (j - taken) * g.dot(&self.error)
        };
        normalized.iter().map(score).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::so3::exp;
    use crate::stats::random_stream;
    use crate::vision::pair::covariance::correlated_modes::MODES;
    use crate::vision::pair::models::General;
    use crate::vision::pair::residual::residual;
    use nalgebra::{Matrix2, Unit, Vector2, Vector3};
    use rand_distr::{Distribution, StandardNormal};

    fn model() -> General {
        let rotation = exp(&Vector3::new(0.02, -0.015, 0.1));
        General { rotation, direction: Unit::new_normalize(Vector3::new(0.4, -0.2, 1.0)) }
    }

    /// Points at several depths, seen without noise.
    fn normalized() -> Vec<NormalizedMatch> {
        let from_covariance = Matrix2::new(4.0, 1.0, 1.0, 2.0) * 1e-8;
        let to_covariance = Matrix2::new(3.0, -1.0, -1.0, 5.0) * 1e-8;
        let place = |k: usize| Vector2::new(0.11 * (k % 5) as f64 - 0.2, 0.07 * (k / 5) as f64 - 0.25);
        let matched = |k: usize| {
            let inverse_depth = 0.02 * (1.0 + 0.3 * (k % 3) as f64);
            let p = model().rotation * place(k).push(1.0) + model().direction.into_inner() * inverse_depth;
            NormalizedMatch { from: place(k), to: p.xy() / p.z, from_covariance, to_covariance }
        };
        (0..40).map(matched).collect()
    }

    /// Greatest difference between the derivatives by the coefficients and those by differences of the residual, over the
    /// greatest of them, where a coefficient of 1 moves the second point by its noise against the first times `size`.
    fn off(size: f64) -> f64 {
        const STEP: f64 = 1e-3;
        let (matrix, _) = model().matrix();
        let (all, mut worst, mut greatest) = (normalized(), 0.0f64, 0.0f64);
        let places = Places::of(&all);
        for matched in &all {
            let by = places.by_coefficients(&matrix, matched);
            let factor = matched.to_covariance.cholesky().expect("positive").l() * std::f64::consts::SQRT_2 * size;
            for i in 0..COEFFICIENTS {
                let error = factor.column(i / MODES) * places.modes(matched)[i % MODES] * STEP;
                let at =
                    |to: Vector2<f64>| residual(Relation::Epipolar, &matrix, &NormalizedMatch { to, ..*matched }).x;
                let numeric = (at(matched.to + error) - at(matched.to - error)) / (2.0 * STEP);
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
    fn the_covariance_is_that_of_many_errors_of_the_true_share() {
        const RUNS: u64 = 4000;
        let all = normalized();
        let (matrix, _) = model().matrix();
        let places = Places::of(&all);
        let sums = Sums::of(&model(), &all, (&places, 1.0));
        let (assumed, truth) = (0.01, 0.2);
        let left = sums.eliminated(assumed).expect("positive");
        let mut random = random_stream(7, "smooth-error", 0);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let by_motion: Vec<SVector<f64, 5>> =
            all.iter().map(|s| linearized(Relation::Epipolar, &model().matrix(), s).1.row(0).transpose()).collect();
        let by_error: Vec<_> = all.iter().map(|s| places.by_coefficients(&matrix, s)).collect();
        let mut mean = SMatrix::<f64, 5, 5>::zeros();
        for _ in 0..RUNS {
            let error = SVector::<f64, COEFFICIENTS>::from_fn(|i, _| variance(i, truth).sqrt() * normal());
            let (mut motion_gradient, mut coefficients_gradient) = (SVector::zeros(), SVector::zeros());
            for (j, g) in by_motion.iter().zip(&by_error) {
                let r = g.dot(&error) + normal();
                motion_gradient += j * r;
                coefficients_gradient += g * r;
            }
            let step =
                Sums { motion_gradient, coefficients_gradient, ..sums }.eliminated(assumed).and_then(|e| e.step());
            let step = step.expect("determined");
            mean += step * step.transpose() / RUNS as f64;
        }
        // A variance out of 4000 runs is known to 2.2 % at 1 sigma.
        let off = |covariance: SMatrix<f64, 5, 5>| {
            (0..5).map(|i| (mean[(i, i)] / covariance[(i, i)] - 1.0).abs()).fold(0.0, f64::max)
        };
        let predicted = |share: f64| sums.covariance(&left, share).expect("positive");
        assert!(off(predicted(truth)) < 0.1, "{}", off(predicted(truth)));
        assert!(off(predicted(assumed)) > 0.3, "the assumed share is too small: {}", off(predicted(assumed)));
        let inverse = left.information.cholesky().expect("positive").inverse();
        assert!(
            (predicted(assumed) - inverse).norm() < 1e-6 * inverse.norm(),
            "with the assumed share it is the usual one"
        );
    }

    #[test]
    fn a_smooth_error_takes_information_away_and_more_with_its_share() {
        let all = normalized();
        let sums = Sums::of(&model(), &all, (&Places::of(&all), 1.0));
        let left = |share: f64| sums.eliminated(share).expect("positive").information;
        let least = |m: SMatrix<f64, 5, 5>| m.symmetric_eigenvalues().min() / sums.motion.trace();
        assert!(least(sums.motion - left(0.01)) > -1e-9 && least(left(0.01) - left(0.1)) > -1e-9);
        assert!((left(1e-12) - sums.motion).norm() < 1e-6 * sums.motion.norm());
        assert!((left(0.1) - sums.motion).norm() > 1e-3 * sums.motion.norm());
    }
}
