//! The covariance moved by a transition, in place: the step that every filter step takes, without allocation.

use super::coordinates::{LandmarkTransition, Transition};
use super::imu::ImuIncrement;
use super::state::{BIASES, WITH_BIASES};
use nalgebra::{DMatrix, Matrix3, SMatrix, SVector, Vector3};

/// P ← F P Fᵀ + G N Gᵀ + B, with the increment's noise N and the biases' walk B.
pub(super) fn propagate(covariance: &mut DMatrix<f64>, transition: &Transition, increment: &ImuIncrement) {
    if transition.own_size == WITH_BIASES {
        let core = transition.by_state;
        moved(covariance, &core, transition);
    } else {
        let core: SMatrix<f64, BIASES, BIASES> = transition.by_state.fixed_view::<BIASES, BIASES>(0, 0).into_owned();
        moved(covariance, &core, transition);
    }
    add_noise(covariance, transition, increment);
    if transition.own_size == WITH_BIASES {
        for k in 0..6 {
            covariance[(BIASES + k, BIASES + k)] += increment.bias_walk[k];
        }
    }
}

/// F P Fᵀ as F (F P)ᵀ, since P is symmetric.
fn moved<const C: usize>(p: &mut DMatrix<f64>, core: &SMatrix<f64, C, C>, transition: &Transition) {
    for _ in 0..2 {
        for mut column in p.column_iter_mut() {
            let column = column.as_mut_slice();
            let own = SVector::<f64, C>::from_column_slice(&column[..C]);
            column[..C].copy_from_slice((core * own).as_slice());
            for (k, landmark) in transition.landmarks.iter().enumerate() {
                let part = &mut column[C + 3 * k..C + 3 * k + 3];
                let mut moved = landmark.by_landmark * Vector3::from_column_slice(part);
                if transition.couples {
                    moved += landmark.by_state.fixed_columns::<C>(0) * own;
                }
                part.copy_from_slice(moved.as_slice());
            }
        }
        p.transpose_mut();
    }
}

/// Adds G N Gᵀ. G maps the noise of the rotation onto every vector that is held in lander axes; that of velocity and
/// position onto the lander alone.
fn add_noise(p: &mut DMatrix<f64>, transition: &Transition, increment: &ImuIncrement) {
    let own = &transition.by_noise;
    let times_noise = own * increment.covariance;
    let mut corner = p.fixed_view_mut::<BIASES, BIASES>(0, 0);
    corner += times_noise * own.transpose();
    let (start, rotation) = (transition.own_size, increment.covariance.fixed_view::<3, 3>(0, 0).into_owned());
    let by_rotation: SMatrix<f64, BIASES, 3> = times_noise.fixed_columns::<3>(0).into_owned();
    for (k, landmark) in transition.landmarks.iter().enumerate() {
        let row = start + 3 * k;
        let cross = by_rotation * landmark.by_rotation_noise.transpose();
        let mut above = p.fixed_view_mut::<BIASES, 3>(0, row);
        above += cross;
        let mut left = p.fixed_view_mut::<3, BIASES>(row, 0);
        left += cross.transpose();
        add_between(p, (&transition.landmarks[..=k], start), (landmark, row), &rotation);
    }
}

/// The noise that landmark `k` shares with those up to it, itself included.
fn add_between(
    p: &mut DMatrix<f64>,
    (others, start): (&[LandmarkTransition], usize),
    (landmark, row): (&LandmarkTransition, usize),
    rotation: &Matrix3<f64>,
) {
    let mine = landmark.by_rotation_noise * rotation;
    for (k, other) in others.iter().enumerate() {
        let column = start + 3 * k;
        let block = mine * other.by_rotation_noise.transpose();
        let mut lower = p.fixed_view_mut::<3, 3>(row, column);
        lower += block;
        if column != row {
            let mut upper = p.fixed_view_mut::<3, 3>(column, row);
            upper += block.transpose();
        }
    }
}
