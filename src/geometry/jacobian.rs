//! Numerical Jacobians, the reference that every analytic one is tested against.

use super::so3::Manifold;
use nalgebra::{SMatrix, SVector};

/// Central-difference Jacobian (`M`×`N`) of `function` at `state`, both sides in their tangent spaces.
///
/// `step` is the half-width in the unit of each tangent component; the error is of the order of `step²`.
pub fn central_difference<S, Y, const N: usize, const M: usize>(
    function: impl Fn(&S) -> Y,
    state: &S,
    step: f64,
) -> SMatrix<f64, M, N>
where
    S: Manifold<N>,
    Y: Manifold<M>,
{
    let mut jacobian = SMatrix::<f64, M, N>::zeros();
    for column in 0..N {
        let mut d = SVector::<f64, N>::zeros();
        d[column] = step;
        let forward = function(&state.plus(&d));
        let backward = function(&state.plus(&-d));
        jacobian.set_column(column, &(forward.minus(&backward) / (2.0 * step)));
    }
    jacobian
}
