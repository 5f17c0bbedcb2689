//! Levenberg–Marquardt fit of a free-body motion to the rotations of one arc.

use super::initial::Guess;
use crate::navigation::tumbling::motion::{InertiaRatios, SpinState, TrajectoryPoint, propagate};
use crate::navigation::tumbling::pair::RotationPair;
use crate::stats::{Damping, LeastSquares, LeastSquaresOptions, NormalEquations, Steps, minimize};
use nalgebra::{Const, SMatrix, SVector, UnitQuaternion, Vector6};

type Vector8 = SVector<f64, 8>;
type Matrix8 = SMatrix<f64, 8, 8>;
type Vector9 = SVector<f64, 9>;
type Matrix9 = SMatrix<f64, 9, 9>;

const DESCENT: LeastSquaresOptions = LeastSquaresOptions {
    steps: Steps::Damped(Damping { start: 1e-4, raise: 8.0, lower: 0.15, least: 1e-12, most: 1e12, takes_level: true }),
    most_steps: 60,
    least_step: 0.0,
    least_drop_share: 1e-10,
    least_drop: 1e-16,
};

/// What is fitted: pairs, the times of their images, a robust width and prior information on the ratios.
#[derive(Clone, Copy)]
pub(super) struct FitProblem<'a> {
    /// Pairs within the arc.
    pub pairs: &'a [RotationPair],
    /// Times of the arc's images in s, the first one 0.
    pub times_s: &'a [f64],
    /// Whitened misfit (3-norm) from which a pair's pull is constant (Huber); infinite for none.
    pub huber: f64,
    /// Information that holds the ratios at a sphere's (5×5).
    pub prior: &'a SMatrix<f64, 5, 5>,
}

/// A fitted motion.
#[derive(Clone)]
pub struct Fit {
    pub guess: Guess,
    pub inertia: InertiaRatios,
    pub points: Vec<TrajectoryPoint>,
    /// Robust cost: half a sum of squares within the width, and the prior's.
    pub cost: f64,
    /// Information (Gauss–Newton) about (initial rate, ratios), prior left out.
    pub information: Matrix8,
    gradient: Vector8,
    ratios_by_shape: SMatrix<f64, 5, 6>,
}

impl FitProblem<'_> {
    /// The motion nearest to the pairs, from a guess; `None` if the guess cannot be integrated.
    pub fn solve(&self, guess: &Guess) -> Option<Fit> {
        Some(minimize(self, self.evaluate(guess)?, &DESCENT).state)
    }

    /// The motion of a guess as it is; `None` if it cannot be integrated.
    pub fn start(&self, guess: &Guess) -> Option<Fit> {
        self.evaluate(guess)
    }

    /// Normal matrix and right side of a step of (rate over its size, shape), the scale of the shape left free.
    fn free_equations(&self, fit: &Fit) -> (Matrix9, Vector9) {
        let mut by_parameters = SMatrix::<f64, 8, 9>::zeros();
        by_parameters.fixed_view_mut::<3, 3>(0, 0).fill_diagonal(fit.guess.rate_rad_s.norm());
        by_parameters.fixed_view_mut::<5, 6>(3, 3).copy_from(&fit.ratios_by_shape);
        let (prior_information, prior_gradient, _) = self.prior_terms(&fit.inertia);
        let normal = by_parameters.transpose() * (fit.information + prior_information) * by_parameters;
        (normal, by_parameters.transpose() * (fit.gradient + prior_gradient))
    }

    fn evaluate(&self, guess: &Guess) -> Option<Fit> {
        let (inertia, ratios_by_shape) = guess.shape.ratios()?;
        let start =
            SpinState { asteroid_from_inertial: UnitQuaternion::identity(), rate_in_asteroid_rad_s: guess.rate_rad_s };
        let points = propagate(&start, &inertia, self.times_s)?;
        let (mut information, mut gradient) = (Matrix8::zeros(), Vector8::zeros());
        let mut cost = self.prior_terms(&inertia).2;
        for pair in self.pairs {
            let (misfit, moves) = pair.whitened(&points);
            let size = misfit.norm();
            let weight = if size > self.huber { self.huber / size } else { 1.0 };
            cost += if size > self.huber { self.huber * (size - 0.5 * self.huber) } else { 0.5 * size * size };
            information += moves.transpose() * moves * weight;
            gradient += moves.transpose() * misfit * weight;
        }
        cost.is_finite().then_some(Fit { guess: *guess, inertia, points, cost, information, gradient, ratios_by_shape })
    }

    fn prior_terms(&self, inertia: &InertiaRatios) -> (Matrix8, Vector8, f64) {
        let away = InertiaRatios::SPHERE.vector() - inertia.vector();
        let pull = self.prior * away;
        let (mut information, mut gradient) = (Matrix8::zeros(), Vector8::zeros());
        information.fixed_view_mut::<5, 5>(3, 3).copy_from(self.prior);
        gradient.fixed_rows_mut::<5>(3).copy_from(&pull);
        (information, gradient, 0.5 * away.dot(&pull))
    }
}

impl LeastSquares for FitProblem<'_> {
    type Size = Const<9>;
    type State = Fit;

    fn normal_equations(&self, fit: &Fit) -> NormalEquations<Const<9>> {
        let (mut information, right_side) = self.free_equations(fit);
        let largest = information.diagonal().max();
        // The scale of C means nothing: a row of its own holds it.
        let scale = fit.guess.shape.entries();
        let mut held = information.fixed_view_mut::<6, 6>(3, 3);
        held += scale * scale.transpose() * largest;
        NormalEquations { information, right_side, cost: fit.cost }
    }

    fn cost(&self, fit: &Fit) -> f64 {
        fit.cost
    }

    fn moved(&self, fit: &Fit, step: &Vector9) -> Option<Fit> {
        let shape_step: Vector6<f64> = step.fixed_rows::<6>(3).into_owned();
        self.evaluate(&Guess {
            rate_rad_s: fit.guess.rate_rad_s + step.fixed_rows::<3>(0) * fit.guess.rate_rad_s.norm(),
            shape: fit.guess.shape.moved(&shape_step),
        })
    }

    fn damp(&self, fit: &Fit, information: &mut Matrix9, damping: f64) {
        let largest = self.free_equations(fit).0.diagonal().max();
        for i in 0..9 {
            information[(i, i)] += damping * information[(i, i)].max(1e-9 * largest);
        }
    }
}
