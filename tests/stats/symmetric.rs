//! The symmetric part of matrices of fixed and of other sizes.

use nalgebra::{DMatrix, Matrix3};
use opnav::stats::symmetric;

fn skewed() -> Matrix3<f64> {
    Matrix3::new(1.0, 0.1, 0.7, 0.3, 2.0, -1e-17, 0.2, 1e17, 3.0)
}

#[test]
fn it_is_half_the_sum_with_the_transpose_bit_for_bit() {
    let m = skewed();
    assert_eq!(symmetric(&m), (m + m.transpose()) * 0.5);
    assert_eq!(symmetric(&m), symmetric(&m).transpose());
    assert_ne!(m, m.transpose(), "there is something to do");
    let large = DMatrix::from_fn(7, 7, |row, column| (row as f64 * 1.3).sin() / (column as f64 + 0.7));
    assert_eq!(symmetric(&large), (&large + large.transpose()) * 0.5);
    assert_eq!(symmetric(&large.view((2, 2), (3, 3))), symmetric(&large).view((2, 2), (3, 3)));
}

#[test]
fn a_symmetric_matrix_stays_and_a_skew_one_vanishes() {
    let m = symmetric(&skewed());
    assert_eq!(symmetric(&m), m);
    assert_eq!(symmetric(&(skewed() - skewed().transpose())), Matrix3::zeros());
    assert_eq!(symmetric(&DMatrix::<f64>::zeros(0, 0)), DMatrix::zeros(0, 0));
}
