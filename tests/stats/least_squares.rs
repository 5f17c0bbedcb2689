//! The damped least-squares loop: why it stops, what it returns, and problems with normal equations of their own.

use nalgebra::{
    Const, DMatrix, DVector, Dyn, Matrix1, Matrix2, Matrix3, SMatrix, SVector, UnitQuaternion, Vector1, Vector2,
    Vector3,
};
use opnav::geometry::{Manifold, so3};
use opnav::stats::{
    Damping, LeastSquares, LeastSquaresOptions, NormalEquations, Residuals, Steps, Stop, minimize, random_stream,
};
use rand_distr::{Distribution, StandardNormal};

pub(super) const DAMPING: Damping =
    Damping { start: 1e-3, raise: 10.0, lower: 0.1, least: 1e-12, most: 1e12, takes_level: false };

/// Levenberg–Marquardt to the last digits.
pub(super) const MARQUARDT: LeastSquaresOptions = LeastSquaresOptions {
    steps: Steps::Damped(DAMPING),
    most_steps: 500,
    least_step: 1e-10,
    least_drop_share: 1e-14,
    least_drop: 1e-30,
};

const FULL: LeastSquaresOptions = LeastSquaresOptions { steps: Steps::Full, ..MARQUARDT };
const HALVED: LeastSquaresOptions = LeastSquaresOptions { steps: Steps::Halved(30), ..MARQUARDT };

type Line = (SVector<f64, 5>, SMatrix<f64, 5, 2>);

/// A line through five points, one of them off.
fn line(x: &Vector2<f64>) -> Line {
    let design = SMatrix::<f64, 5, 2>::from_fn(|i, j| if j == 0 { 1.0 } else { i as f64 });
    let y = SVector::from([1.0, 3.1, 4.8, 7.0, 9.3]);
    (design * x - y, design)
}

fn arctangent(x: &Vector1<f64>) -> (Vector1<f64>, Matrix1<f64>) {
    (Vector1::new(x[0].atan()), Matrix1::new(1.0 / (1.0 + x[0] * x[0])))
}

/// Of two unknowns the first alone shows.
fn first_alone(x: &Vector2<f64>) -> (Vector2<f64>, Matrix2<f64>) {
    (Vector2::new(x[0] - 1.0, 0.0), Matrix2::new(1.0, 0.0, 0.0, 0.0))
}

#[test]
fn a_linear_problem_is_solved_in_one_full_step() {
    let end = minimize(&Residuals::new(line), Vector2::zeros(), &LeastSquaresOptions { most_steps: 1, ..FULL });
    let (r, design) = line(&end.state);
    assert!((design.tr_mul(&r)).norm() < 1e-12, "the residuals stand upright on the design: {r}");
    let covariance = end.covariance().expect("determined");
    let expected = (design.tr_mul(&design)).try_inverse().expect("regular");
    assert!((covariance - expected).norm() < 1e-14);
    assert!((end.normal.cost - 0.5 * r.norm_squared()).abs() < 1e-15);
}

#[test]
fn every_reason_to_stop_is_told() {
    let problem = Residuals::new(line);
    let stop = |options: LeastSquaresOptions| minimize(&problem, Vector2::new(3.0, 3.0), &options).stop;
    assert_eq!(
        stop(LeastSquaresOptions { least_step: 1e-3, least_drop_share: 0.0, least_drop: 0.0, ..MARQUARDT }),
        Stop::SmallStep
    );
    assert_eq!(stop(LeastSquaresOptions { least_step: 0.0, least_drop_share: 1e-3, ..MARQUARDT }), Stop::SmallDrop);
    assert_eq!(
        stop(LeastSquaresOptions { least_step: 0.0, least_drop_share: 0.0, least_drop: 100.0, ..MARQUARDT }),
        Stop::SmallDrop
    );
    assert_eq!(stop(LeastSquaresOptions { most_steps: 2, ..MARQUARDT }), Stop::StepLimit);
    assert_eq!(stop(LeastSquaresOptions { most_steps: 0, ..MARQUARDT }), Stop::StepLimit);
    assert!(Stop::SmallStep.is_convergence() && Stop::SmallDrop.is_convergence());
    assert!(![Stop::StepLimit, Stop::Singular, Stop::NoDescent].iter().any(|stop| stop.is_convergence()));
}

/// Full and halved steps need every unknown; damped ones leave alone what does not show, and there is no covariance.
#[test]
fn an_unknown_that_does_not_show_makes_the_problem_singular() {
    let start = Vector2::new(5.0, 7.0);
    for options in [FULL, HALVED] {
        let end = minimize(&Residuals::new(first_alone), start, &options);
        assert_eq!((end.stop, end.state, end.covariance()), (Stop::Singular, start, None));
    }
    let end = minimize(&Residuals::new(first_alone), start, &MARQUARDT);
    assert!((end.state - Vector2::new(1.0, 7.0)).norm() < 1e-9 && end.covariance().is_none(), "{}", end.state);
    let nothing = Residuals::new(|_: &Vector2<f64>| (Vector2::new(1.0, 2.0), Matrix2::zeros()));
    assert_eq!(minimize(&nothing, start, &MARQUARDT).stop, Stop::Singular);
    let both = Residuals::new(|x: &Vector2<f64>| (x - Vector2::new(1.0, 2.0), Matrix2::identity()));
    assert!(minimize(&both, start, &MARQUARDT).covariance().is_some(), "it shows that both are determined");
}

/// At the minimum no step lowers the cost; one that leaves it as it is may count.
#[test]
fn at_the_minimum_there_is_no_descent() {
    let flat = Residuals::new(|x: &Vector1<f64>| (Vector1::new(1.0 + 0.0 * x[0]), Matrix1::new(1.0)));
    for options in [HALVED, MARQUARDT] {
        let end = minimize(&flat, Vector1::new(0.3), &options);
        assert_eq!((end.stop, end.state[0]), (Stop::NoDescent, 0.3));
    }
    let level = Steps::Damped(Damping { takes_level: true, ..DAMPING });
    let end = minimize(&flat, Vector1::new(0.3), &LeastSquaresOptions { steps: level, ..MARQUARDT });
    assert_eq!((end.stop, end.steps), (Stop::SmallDrop, 1));
    assert_ne!(end.state[0], 0.3);
}

/// The arctangent from 3: full steps fly off, the others come down.
#[test]
fn damped_and_halved_steps_converge_where_full_ones_diverge() {
    let problem = Residuals::new(arctangent);
    for options in [HALVED, MARQUARDT] {
        let end = minimize(&problem, Vector1::new(3.0), &options);
        assert!(end.state[0].abs() < 1e-6, "{:?}: {}", options.steps, end.state);
    }
    let end = minimize(&problem, Vector1::new(3.0), &LeastSquaresOptions { most_steps: 20, ..FULL });
    assert!(!end.stop.is_convergence() && end.normal.cost > 1.0, "{:?}: {}", end.stop, end.state);
}

#[test]
fn a_cost_never_rises_unless_steps_are_full() {
    let mut before = f64::INFINITY;
    for most_steps in 0..15 {
        let end =
            minimize(&Residuals::new(arctangent), Vector1::new(3.0), &LeastSquaresOptions { most_steps, ..MARQUARDT });
        assert!(end.normal.cost <= before && end.steps <= most_steps);
        before = end.normal.cost;
    }
}

/// A square root that has no value beyond 0: such candidates are refused, not taken.
#[test]
fn what_is_no_number_is_refused() {
    let root = Residuals::new(|x: &Vector1<f64>| (Vector1::new(x[0].sqrt() - 0.1), Matrix1::new(0.5 / x[0].sqrt())));
    for options in [HALVED, MARQUARDT] {
        let end = minimize(&root, Vector1::new(9.0), &options);
        assert!((end.state[0] - 0.01).abs() < 1e-6, "{}", end.state);
    }
    let end = minimize(&root, Vector1::new(-1.0), &MARQUARDT);
    assert!(end.stop == Stop::Singular && end.state[0] == -1.0 && end.normal.cost.is_nan());
}

/// The mean of attitudes: the information of 12 measurements of unit variance, and a residual without a mean.
#[test]
fn a_state_on_a_manifold_converges() {
    let mean = so3::exp(&Vector3::new(0.4, -2.0, 1.1));
    let mut random = random_stream(5, "attitudes", 0);
    let seen: Vec<UnitQuaternion<f64>> =
        (0..12).map(|_| mean.plus(&(Vector3::from_fn(|_, _| StandardNormal.sample(&mut random)) * 0.05))).collect();
    let residuals = |q: &UnitQuaternion<f64>| {
        let (mut r, mut jacobian) = (SVector::<f64, 36>::zeros(), SMatrix::<f64, 36, 3>::zeros());
        for (k, one) in seen.iter().enumerate() {
            let off = q.minus(one);
            r.fixed_rows_mut::<3>(3 * k).copy_from(&off);
            jacobian.fixed_rows_mut::<3>(3 * k).copy_from(&so3::right_jacobian_inverse(&off));
        }
        (r, jacobian)
    };
    let end = minimize(&Residuals::new(residuals), UnitQuaternion::identity(), &MARQUARDT);
    assert!(end.stop.is_convergence() && end.state.angle_to(&mean) < 0.06, "{:?}", end.stop);
    let covariance = end.covariance().expect("determined");
    assert!((covariance * 12.0 - Matrix3::identity()).norm() < 0.02, "{covariance}");
    let counted = allocation_counter::measure(|| {
        std::hint::black_box(minimize(&Residuals::new(residuals), UnitQuaternion::identity(), &MARQUARDT).steps);
    });
    assert_eq!(counted.count_total, 0, "fixed sizes allocate nothing");
}

/// The same line with sizes that are known at run time only.
struct DynamicLine;

impl LeastSquares for DynamicLine {
    type Size = Dyn;
    type State = DVector<f64>;

    fn normal_equations(&self, state: &DVector<f64>) -> NormalEquations<Dyn> {
        let (r, design) = line(&Vector2::new(state[0], state[1]));
        let (r, design) =
            (DVector::from_column_slice(r.as_slice()), DMatrix::from_column_slice(5, 2, design.as_slice()));
        NormalEquations {
            information: design.tr_mul(&design),
            right_side: -design.tr_mul(&r),
            cost: 0.5 * r.norm_squared(),
        }
    }

    fn moved(&self, state: &DVector<f64>, step: &DVector<f64>) -> Option<DVector<f64>> {
        Some(state + step)
    }
}

#[test]
fn sizes_known_at_run_time_give_the_same_result() {
    for options in [FULL, HALVED, MARQUARDT] {
        let end = minimize(&DynamicLine, DVector::zeros(2), &options);
        let fixed = minimize(&Residuals::new(line), Vector2::zeros(), &options);
        let off = end.state - DVector::from_column_slice(fixed.state.as_slice());
        assert!(off.norm() < 1e-9, "{:?}: {off}", options.steps);
    }
}

/// A line whose points pull by Cauchy's weights, and which damps its offset alone; `reversed` turns its gradient round.
struct RobustLine {
    width: f64,
    reversed: bool,
}

impl LeastSquares for RobustLine {
    type Size = Const<2>;
    type State = Vector2<f64>;

    fn normal_equations(&self, state: &Vector2<f64>) -> NormalEquations<Const<2>> {
        let (mut r, design) = line(state);
        r[4] += 100.0;
        let (mut information, mut right_side, mut cost) = (Matrix2::zeros(), Vector2::zeros(), 0.0);
        for (residual, row) in r.iter().zip(design.row_iter()) {
            let square = (residual / self.width).powi(2);
            information += row.tr_mul(&row) / (1.0 + square);
            right_side -= row.transpose() * (residual / (1.0 + square));
            cost += 0.5 * self.width.powi(2) * square.ln_1p();
        }
        let sign = if self.reversed { -1.0 } else { 1.0 };
        NormalEquations { information, right_side: right_side * sign, cost }
    }

    fn moved(&self, state: &Vector2<f64>, step: &Vector2<f64>) -> Option<Vector2<f64>> {
        let moved = state + step;
        (moved.norm() < 1e6).then_some(moved)
    }

    fn damp(&self, _state: &Vector2<f64>, information: &mut Matrix2<f64>, damping: f64) {
        information[(0, 0)] += damping;
    }

    fn length(&self, step: &Vector2<f64>) -> f64 {
        step.amax()
    }
}

#[test]
fn robust_weights_pass_over_a_wrong_point() {
    let start = Vector2::new(1.0, 2.0);
    let robust = minimize(&RobustLine { width: 1.0, reversed: false }, start, &MARQUARDT);
    assert!((robust.state - Vector2::new(1.0, 2.0)).norm() < 0.3, "{}", robust.state);
    let plain = minimize(&RobustLine { width: 1e6, reversed: false }, start, &MARQUARDT);
    assert!((plain.state - Vector2::new(1.0, 2.0)).norm() > 10.0, "{}", plain.state);
}

#[test]
fn a_gradient_of_the_wrong_sign_finds_no_descent() {
    for options in [HALVED, MARQUARDT] {
        let end = minimize(&RobustLine { width: 1e6, reversed: true }, Vector2::new(1.0, 2.0), &options);
        assert_eq!((end.stop, end.state), (Stop::NoDescent, Vector2::new(1.0, 2.0)));
    }
}
