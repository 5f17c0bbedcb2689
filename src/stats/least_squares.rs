//! Damped least squares: Gauss–Newton steps on normal equations, made shorter where they would not lower the cost.
//!
//! A problem assembles its own normal equations, so robust weights, priors, eliminated unknowns and scoring of a likelihood
//! all descend by the same loop. States move as they like (on a manifold, with an evaluation in tow); sizes are fixed
//! (`Const<N>`: nothing is allocated) or not (`Dyn`). Sources: Marquardt, "An algorithm for least-squares estimation of
//! nonlinear parameters" (1963); Nocedal and Wright, "Numerical Optimization" (2006), chapter 10.

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, DimSub, Dyn, OMatrix, OVector};

/// What the linearised problem says of a step: `information · step = right_side`.
#[derive(Debug, Clone)]
pub struct NormalEquations<D: Dim>
where
    DefaultAllocator: Allocator<D, D> + Allocator<D>,
{
    /// Second derivative of the cost by the step, or what stands for it: of whitened residuals, the information.
    pub information: OMatrix<f64, D, D>,
    /// The cost's negative gradient.
    pub right_side: OVector<f64, D>,
    /// What shall become small.
    pub cost: f64,
}

/// A problem that steps on normal equations solve.
pub trait LeastSquares
where
    DefaultAllocator: Allocator<Self::Size, Self::Size> + Allocator<Self::Size>,
{
    /// Number of unknowns: `Const<N>` or `Dyn`.
    type Size: Dim + DimSub<Dyn>;
    /// What is sought, with whatever of its evaluation is worth keeping.
    type State;

    /// Normal equations at a state.
    fn normal_equations(&self, state: &Self::State) -> NormalEquations<Self::Size>;

    /// Cost of a state alone; what is no number is refused.
    fn cost(&self, state: &Self::State) -> f64 {
        self.normal_equations(state).cost
    }

    /// The state moved by a step; `None` where there is none.
    fn moved(&self, state: &Self::State, step: &OVector<f64, Self::Size>) -> Option<Self::State>;

    /// Adds damping to the information at a state: a share of its own diagonal (Marquardt), and of next to nothing of the
    /// greatest where an unknown does not show.
    fn damp(&self, _state: &Self::State, information: &mut OMatrix<f64, Self::Size, Self::Size>, damping: f64) {
        let least = 1e-9 * information.diagonal().max();
        for i in 0..information.nrows() {
            information[(i, i)] += damping * information[(i, i)].max(least);
        }
    }

    /// Length of a step, in the unit of [`LeastSquaresOptions::least_step`].
    fn length(&self, step: &OVector<f64, Self::Size>) -> f64 {
        step.norm()
    }
}

/// How damping (without a unit, a share of the information) follows success.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Damping {
    /// That of the first step, and the least one after a matrix that has no inverse.
    pub start: f64,
    /// Factor after a step that was refused.
    pub raise: f64,
    /// Factor after a step that was taken.
    pub lower: f64,
    /// Never less than this.
    pub least: f64,
    /// The descent ends beyond this.
    pub most: f64,
    /// Whether a step that leaves the cost as it is counts as one that lowers it.
    pub takes_level: bool,
}

/// Which steps are taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Steps {
    /// Every Gauss–Newton step as it is: for weights that move from step to step, so that costs cannot be compared.
    Full,
    /// Gauss–Newton steps, halved until one of so many lowers the cost.
    Halved(i32),
    /// Levenberg–Marquardt steps that lower the cost.
    Damped(Damping),
}

/// Which steps are taken, and when they end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeastSquaresOptions {
    /// Which steps are taken.
    pub steps: Steps,
    /// Most steps, those that are damped further included.
    pub most_steps: usize,
    /// A step shorter than this is the last, in the unit of [`LeastSquares::length`].
    pub least_step: f64,
    /// A drop of the cost within this share of it is the last…
    pub least_drop_share: f64,
    /// …with this added; the drops of [`Steps::Full`] do not count.
    pub least_drop: f64,
}

impl Steps {
    /// Damping of the first step.
    fn first_damping(self) -> f64 {
        if let Steps::Damped(damping) = self { damping.start } else { 0.0 }
    }

    /// Damping after a step that was taken.
    fn lowered(self, now: f64) -> f64 {
        if let Steps::Damped(damping) = self { (now * damping.lower).max(damping.least) } else { now }
    }

    /// Damping after a step that was refused; `None` if there is no use in going on.
    fn raised(self, now: f64, refusal: Stop) -> Option<f64> {
        let Steps::Damped(damping) = self else { return None };
        let least = if refusal == Stop::Singular { damping.start } else { 0.0 };
        Some((now * damping.raise).max(least)).filter(|raised| *raised <= damping.most)
    }
}

impl LeastSquaresOptions {
    /// Whether a step of this length that took the cost down to that was the last one, and why.
    fn settled(&self, before: f64, after: f64, length: f64) -> Option<Stop> {
        let small_drop = before - after <= self.least_drop_share * before + self.least_drop;
        if small_drop && self.steps != Steps::Full {
            return Some(Stop::SmallDrop);
        }
        (length < self.least_step).then_some(Stop::SmallStep)
    }
}

/// Why a descent ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stop {
    /// The last step was short.
    SmallStep,
    /// The last drop of the cost was small.
    SmallDrop,
    /// All steps are spent.
    StepLimit,
    /// The normal equations have no solution, however damped: not every unknown is determined.
    Singular,
    /// No step, however short or damped, lowers the cost.
    NoDescent,
}

impl Stop {
    /// Whether the state rests where it ended.
    pub fn is_convergence(self) -> bool {
        matches!(self, Stop::SmallStep | Stop::SmallDrop)
    }
}

/// Where a descent ended.
#[derive(Debug, Clone)]
pub struct Minimum<S, D: Dim>
where
    DefaultAllocator: Allocator<D, D> + Allocator<D>,
{
    /// The best state.
    pub state: S,
    /// The normal equations there.
    pub normal: NormalEquations<D>,
    /// Why it ended there.
    pub stop: Stop,
    /// Steps tried.
    pub steps: usize,
}

impl<S, D: Dim + DimSub<Dyn>> Minimum<S, D>
where
    DefaultAllocator: Allocator<D, D> + Allocator<D>,
{
    /// Inverse of the information, in the units of the step: the covariance where residuals are whitened; `None` where not
    /// every unknown is determined.
    pub fn covariance(&self) -> Option<OMatrix<f64, D, D>> {
        self.normal.information.clone().cholesky().map(|factor| factor.inverse())
    }
}

/// Descends from a start. What was reached is returned whatever ended the descent: [`Minimum::stop`] says what it is worth.
pub fn minimize<P: LeastSquares>(
    problem: &P,
    start: P::State,
    options: &LeastSquaresOptions,
) -> Minimum<P::State, P::Size>
where
    DefaultAllocator: Allocator<P::Size, P::Size> + Allocator<P::Size>,
{
    let normal = problem.normal_equations(&start);
    let mut reached = Minimum { state: start, normal, stop: Stop::StepLimit, steps: 0 };
    let mut damping = options.steps.first_damping();
    while reached.steps < options.most_steps {
        reached.steps += 1;
        match next(problem, &reached, options.steps, damping) {
            Ok((state, length)) => {
                let before = reached.normal.cost;
                reached.normal = problem.normal_equations(&state);
                reached.state = state;
                if let Some(stop) = options.settled(before, reached.normal.cost, length) {
                    return Minimum { stop, ..reached };
                }
                damping = options.steps.lowered(damping);
            }
            Err(refusal) => match options.steps.raised(damping, refusal) {
                Some(raised) => damping = raised,
                None => return Minimum { stop: refusal, ..reached },
            },
        }
    }
    reached
}

/// The state after one more step and the step's length; why there is none.
fn next<P: LeastSquares>(
    problem: &P,
    at: &Minimum<P::State, P::Size>,
    steps: Steps,
    damping: f64,
) -> Result<(P::State, f64), Stop>
where
    DefaultAllocator: Allocator<P::Size, P::Size> + Allocator<P::Size>,
{
    let mut information = at.normal.information.clone();
    if let Steps::Damped(_) = steps {
        problem.damp(&at.state, &mut information, damping);
    }
    let step = information.cholesky().ok_or(Stop::Singular)?.solve(&at.normal.right_side);
    if !step.iter().all(|value| value.is_finite()) {
        return Err(Stop::Singular);
    }
    let accepts = |state: &P::State| match steps {
        Steps::Full => true,
        Steps::Damped(Damping { takes_level: true, .. }) => problem.cost(state) <= at.normal.cost,
        Steps::Halved(_) | Steps::Damped(_) => problem.cost(state) < at.normal.cost,
    };
    let taken = |step: &OVector<f64, P::Size>| {
        problem.moved(&at.state, step).filter(accepts).map(|state| (state, problem.length(step)))
    };
    let found = match steps {
        Steps::Halved(trials) => (0..trials).find_map(|halvings| taken(&(&step * 0.5f64.powi(halvings)))),
        Steps::Full | Steps::Damped(_) => taken(&step),
    };
    found.ok_or(Stop::NoDescent)
}
