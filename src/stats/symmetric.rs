//! The symmetric part of a matrix.

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, Matrix, OMatrix, RawStorage};

/// `(m + mᵀ) / 2`, exactly symmetric: a covariance or an information without what rounding did to it.
pub fn symmetric<D: Dim, S: RawStorage<f64, D, D>>(m: &Matrix<f64, D, D, S>) -> OMatrix<f64, D, D>
where
    DefaultAllocator: Allocator<D, D>,
{
    let (rows, columns) = m.shape_generic();
    OMatrix::from_fn_generic(rows, columns, |row, column| (m[(row, column)] + m[(column, row)]) * 0.5)
}
