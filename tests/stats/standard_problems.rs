//! The damped least-squares loop on problems of Moré, Garbow and Hillstrom, "Testing unconstrained optimization software"
//! (1981): their starts, and their sums of squares at the solution.

use super::least_squares::{DAMPING, MARQUARDT};
use nalgebra::{Const, SMatrix, SVector};
use opnav::geometry::central_difference;
use opnav::stats::{Damping, LeastSquaresOptions, Minimum, Residuals, Steps, Stop, minimize};

/// To where rounding hides whether the cost still falls.
const TO_THE_END: LeastSquaresOptions =
    LeastSquaresOptions { steps: Steps::Damped(Damping { takes_level: true, ..DAMPING }), ..MARQUARDT };

type Function<const N: usize, const M: usize> = fn(&SVector<f64, N>) -> SVector<f64, M>;

fn solved<const N: usize, const M: usize>(
    function: Function<N, M>,
    start: [f64; N],
    options: &LeastSquaresOptions,
) -> Minimum<SVector<f64, N>, Const<N>> {
    let with_jacobian = |x: &SVector<f64, N>| -> (SVector<f64, M>, SMatrix<f64, M, N>) {
        (function(x), central_difference(function, x, 1e-6))
    };
    minimize(&Residuals::new(with_jacobian), SVector::from(start), options)
}

/// All starts must lead to the sum of squares.
fn reaches<const N: usize, const M: usize>(function: Function<N, M>, starts: &[[f64; N]], sum_of_squares: f64) {
    for start in starts {
        let end = solved(function, *start, &TO_THE_END);
        let found = 2.0 * end.normal.cost;
        assert!(end.stop.is_convergence(), "{start:?}: {:?} after {}", end.stop, end.steps);
        assert!((found - sum_of_squares).abs() < 1e-5 * sum_of_squares + 1e-12, "{start:?}: {found}");
    }
}

fn rosenbrock(x: &SVector<f64, 2>) -> SVector<f64, 2> {
    SVector::from([10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]])
}

fn powell_singular(x: &SVector<f64, 4>) -> SVector<f64, 4> {
    SVector::from([
        x[0] + 10.0 * x[1],
        5f64.sqrt() * (x[2] - x[3]),
        (x[1] - 2.0 * x[2]).powi(2),
        10f64.sqrt() * (x[0] - x[3]).powi(2),
    ])
}

fn freudenstein_roth(x: &SVector<f64, 2>) -> SVector<f64, 2> {
    let y = x[1];
    SVector::from([-13.0 + x[0] + ((5.0 - y) * y - 2.0) * y, -29.0 + x[0] + ((y + 1.0) * y - 14.0) * y])
}

fn helical_valley(x: &SVector<f64, 3>) -> SVector<f64, 3> {
    let turn = (x[1] / x[0]).atan() / std::f64::consts::TAU + if x[0] < 0.0 { 0.5 } else { 0.0 };
    SVector::from([10.0 * (x[2] - 10.0 * turn), 10.0 * (x[0].hypot(x[1]) - 1.0), x[2]])
}

fn beale(x: &SVector<f64, 2>) -> SVector<f64, 3> {
    SVector::from([1.5, 2.25, 2.625]) - SVector::from_fn(|i, _| x[0] * (1.0 - x[1].powi(i as i32 + 1)))
}

fn bard(x: &SVector<f64, 3>) -> SVector<f64, 15> {
    const Y: [f64; 15] = [0.14, 0.18, 0.22, 0.25, 0.29, 0.32, 0.35, 0.39, 0.37, 0.58, 0.73, 0.96, 1.34, 2.10, 4.39];
    SVector::from_fn(|i, _| {
        let (u, v) = (i as f64 + 1.0, 15.0 - i as f64);
        Y[i] - (x[0] + u / (v * x[1] + u.min(v) * x[2]))
    })
}

fn kowalik_osborne(x: &SVector<f64, 4>) -> SVector<f64, 11> {
    const Y: [f64; 11] = [0.1957, 0.1947, 0.1735, 0.1600, 0.0844, 0.0627, 0.0456, 0.0342, 0.0323, 0.0235, 0.0246];
    const U: [f64; 11] = [4.0, 2.0, 1.0, 0.5, 0.25, 0.167, 0.125, 0.1, 0.0833, 0.0714, 0.0625];
    SVector::from_fn(|i, _| {
        let u = U[i];
        Y[i] - x[0] * (u * u + u * x[1]) / (u * u + u * x[2] + x[3])
    })
}

#[test]
fn valleys_without_residuals_are_followed_to_their_ends() {
    reaches(rosenbrock, &[[-1.2, 1.0], [-12.0, 10.0]], 0.0);
    reaches(helical_valley, &[[-1.0, 0.0, 0.0], [-10.0, 0.0, 0.0]], 0.0);
    reaches(beale, &[[1.0, 1.0]], 0.0);
    let end = solved(rosenbrock, [-1.2, 1.0], &TO_THE_END);
    assert!((end.state - SVector::from([1.0, 1.0])).norm() < 1e-6, "{}", end.state);
}

#[test]
fn residuals_that_stay_are_those_of_the_table() {
    reaches(bard, &[[1.0, 1.0, 1.0]], 8.214_87e-3);
    reaches(kowalik_osborne, &[[0.25, 0.39, 0.415, 0.39]], 3.075_05e-4);
    reaches(freudenstein_roth, &[[0.5, -2.0]], 48.984_2);
}

/// The Jacobian loses two of its four ranks at the solution: convergence is slow, and there is no covariance worth having.
#[test]
fn powells_singular_function_is_approached() {
    let end = solved(powell_singular, [3.0, -1.0, 0.0, 1.0], &TO_THE_END);
    assert!(end.normal.cost < 1e-12 && end.state.norm() < 1e-2, "{} {}", end.normal.cost, end.state);
    let information = end.normal.information.symmetric_eigenvalues();
    assert!(information.min() < 1e-4 * information.max(), "{information}");
}

/// A local minimum is one: from its standard start Freudenstein and Roth's function does not find its zero at (5, 4).
#[test]
fn a_start_beside_the_zero_finds_it_and_the_standard_one_does_not() {
    let near = solved(freudenstein_roth, [4.5, 3.5], &TO_THE_END);
    assert!((near.state - SVector::from([5.0, 4.0])).norm() < 1e-6, "{}", near.state);
    let far = solved(freudenstein_roth, [0.5, -2.0], &TO_THE_END);
    assert!((far.state[0] - 11.41).abs() < 0.01 && (far.state[1] + 0.8968).abs() < 1e-4, "{}", far.state);
}

#[test]
fn halved_steps_reach_the_same_minimum() {
    let halved = LeastSquaresOptions { steps: Steps::Halved(20), ..MARQUARDT };
    let end = solved(bard, [1.0, 1.0, 1.0], &halved);
    assert!((2.0 * end.normal.cost - 8.214_87e-3).abs() < 1e-7 && end.stop != Stop::StepLimit, "{:?}", end.stop);
}
