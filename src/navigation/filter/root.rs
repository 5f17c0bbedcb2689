//! A square root of a covariance, which may have directions without any uncertainty.

use nalgebra::SMatrix;

/// A pivot below this fraction of its variance counts as 0.
const ROUNDING: f64 = 1e-12;

/// Lower triangular `L` with `L Lᵀ = P`, a column of zeros for each direction that is known exactly; `None` if `P` is not
/// positive semidefinite.
pub(super) fn covariance_root<const N: usize>(p: &SMatrix<f64, N, N>) -> Option<SMatrix<f64, N, N>> {
    let mut root = SMatrix::<f64, N, N>::zeros();
    for k in 0..N {
        let rounding = ROUNDING * p[(k, k)].abs();
        let pivot = p[(k, k)] - (0..k).map(|j| root[(k, j)] * root[(k, j)]).sum::<f64>();
        if pivot.is_nan() || pivot < -rounding {
            return None;
        }
        if pivot <= rounding {
            continue;
        }
        let diagonal = pivot.sqrt();
        root[(k, k)] = diagonal;
        for i in k + 1..N {
            let left = p[(i, k)] - (0..k).map(|j| root[(i, j)] * root[(k, j)]).sum::<f64>();
            root[(i, k)] = left / diagonal;
        }
    }
    Some(root)
}
