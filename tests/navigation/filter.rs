//! Tests of the wing `navigation::filter`.

mod consistency;
mod correction;
mod covariance_intersection;
mod ekf;
#[cfg(feature = "scene")]
mod manifold;
mod unscented;

use nalgebra::{SMatrix, SVector};
use opnav::stats::random_stream;
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

fn stream(index: u64) -> ChaCha8Rng {
    random_stream(7, "filter tests", index)
}

/// Independent draws of variance 1.
fn white<const N: usize>(random: &mut impl Rng) -> SVector<f64, N> {
    SVector::from_fn(|_, _| StandardNormal.sample(random))
}

/// A covariance of no particular shape.
fn covariance<const N: usize>(random: &mut impl Rng) -> SMatrix<f64, N, N> {
    let root = SMatrix::<f64, N, N>::from_fn(|_, _| StandardNormal.sample(random));
    root * root.transpose() + SMatrix::identity() * 0.05
}

fn least_eigenvalue<const N: usize>(matrix: &SMatrix<f64, N, N>) -> f64 {
    nalgebra::DMatrix::from_column_slice(N, N, matrix.as_slice()).symmetric_eigenvalues().min()
}
