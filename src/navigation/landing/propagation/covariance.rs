//! The covariance moved by a transition, in place: the step that every filter step takes, without allocation.

use crate::navigation::landing::error_state::{
    ATTITUDE, BIASES, LandmarkTransition, POSITION, Transition, VELOCITY, WITH_BIASES,
};
use crate::navigation::landing::inertial::ImuIncrement;
use nalgebra::{DMatrix, Matrix3, SMatrix, SVector, Vector3};

/// P ← F P Fᵀ + G N Gᵀ + B, with the increment's noise N and the biases' walk B.
pub(super) fn propagate(covariance: &mut DMatrix<f64>, transition: &Transition, increment: &ImuIncrement) {
    let blocks = Blocks::of(transition);
    for _ in 0..2 {
        // F P Fᵀ as F (F P)ᵀ, since P is symmetric.
        for mut column in covariance.column_iter_mut() {
            move_column(column.as_mut_slice(), &blocks, transition);
        }
        covariance.transpose_mut();
    }
    add_noise(covariance, transition, increment);
    if transition.own_size == WITH_BIASES {
        for k in 0..6 {
            covariance[(BIASES + k, BIASES + k)] += increment.bias_walk[k];
        }
    }
}

/// F of position, velocity and attitude in blocks of three; only the first column of the second row may be 0 or not, the
/// attitude moves by itself alone.
struct Blocks {
    position: [Matrix3<f64>; 3],
    velocity: [Matrix3<f64>; 3],
    attitude: Matrix3<f64>,
}

impl Blocks {
    fn of(transition: &Transition) -> Self {
        let block = |row: usize, column: usize| transition.by_state.fixed_view::<3, 3>(row, column).into_owned();
        let row = |start: usize| [POSITION, VELOCITY, ATTITUDE].map(|column| block(start, column));
        Blocks { position: row(POSITION), velocity: row(VELOCITY), attitude: block(ATTITUDE, ATTITUDE) }
    }
}

/// x ← F x.
fn move_column(column: &mut [f64], blocks: &Blocks, transition: &Transition) {
    let read = |column: &[f64], start: usize| Vector3::new(column[start], column[start + 1], column[start + 2]);
    let (p, v, a) = (read(column, POSITION), read(column, VELOCITY), read(column, ATTITUDE));
    let own_size = transition.own_size;
    for (k, landmark) in transition.landmarks.iter().enumerate() {
        let start = own_size + 3 * k;
        let mut moved = landmark.by_landmark * read(column, start);
        if transition.couples {
            moved += landmark.by_state.columns(0, own_size) * VectorView::from_slice(&column[..own_size], own_size);
        }
        column[start..start + 3].copy_from_slice(moved.as_slice());
    }
    let mut position = blocks.position[0] * p + blocks.position[1] * v + blocks.position[2] * a;
    let mut velocity = blocks.velocity[1] * v + blocks.velocity[2] * a;
    let mut attitude = blocks.attitude * a;
    if transition.couples {
        velocity += blocks.velocity[0] * p;
        if own_size == WITH_BIASES {
            let biases = SVector::<f64, 6>::from_column_slice(&column[BIASES..WITH_BIASES]);
            position += transition.by_state.fixed_view::<3, 6>(POSITION, BIASES) * biases;
            velocity += transition.by_state.fixed_view::<3, 6>(VELOCITY, BIASES) * biases;
            attitude += transition.by_state.fixed_view::<3, 6>(ATTITUDE, BIASES) * biases;
        }
    }
    column[POSITION..VELOCITY].copy_from_slice(position.as_slice());
    column[VELOCITY..ATTITUDE].copy_from_slice(velocity.as_slice());
    column[ATTITUDE..BIASES].copy_from_slice(attitude.as_slice());
}

type VectorView<'a> = nalgebra::DVectorView<'a, f64>;

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
