//! How errors move from one image to the next.

use super::state::{BIASES, WITH_BIASES};
use crate::navigation::landing::inertial::ImuIncrement;
use nalgebra::{DMatrix, Matrix3, SMatrix};
use smallvec::SmallVec;

/// Linearised motion of the error state, `e_j = F e_i + G n` with the increment's noise n (9), in blocks.
#[derive(Debug, Clone, PartialEq)]
pub struct Transition {
    /// Size of the lander's own error state: 9, or 15 with biases.
    pub own_size: usize,
    /// F of the own error state; the rows and columns from `own_size` on are not used.
    pub by_state: SMatrix<f64, WITH_BIASES, WITH_BIASES>,
    /// G of the own error state without biases.
    pub by_noise: SMatrix<f64, BIASES, BIASES>,
    /// The landmarks, in their order.
    pub landmarks: SmallVec<[LandmarkTransition; 4]>,
    /// Whether the own error state moves landmarks: it does where the planet turns or biases are estimated.
    pub couples: bool,
}

/// The rows of one landmark.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LandmarkTransition {
    /// By the landmark itself.
    pub by_landmark: Matrix3<f64>,
    /// By the own error state; the columns from its size on are not used.
    pub by_state: SMatrix<f64, 3, WITH_BIASES>,
    /// By the noise of the increment's rotation.
    pub by_rotation_noise: Matrix3<f64>,
}

impl Transition {
    /// With the columns of the biases: a bias that is off by b leaves the increment off by `by_bias` b.
    pub(super) fn with_biases(mut self, increment: &ImuIncrement) -> Self {
        let by_bias = self.by_noise * increment.by_bias;
        self.by_state.fixed_view_mut::<BIASES, 6>(0, BIASES).copy_from(&by_bias);
        for k in BIASES..WITH_BIASES {
            self.by_state[(k, k)] = 1.0;
        }
        let rotation = increment.by_bias.fixed_rows::<3>(0).into_owned();
        for landmark in &mut self.landmarks {
            landmark.by_state.fixed_view_mut::<3, 6>(0, BIASES).copy_from(&(landmark.by_rotation_noise * rotation));
        }
        self.own_size = WITH_BIASES;
        self.couples = true;
        self
    }

    /// F as one matrix.
    pub fn state_matrix(&self) -> DMatrix<f64> {
        let n = self.own_size + 3 * self.landmarks.len();
        let mut f = DMatrix::zeros(n, n);
        f.view_mut((0, 0), (self.own_size, self.own_size))
            .copy_from(&self.by_state.view((0, 0), (self.own_size, self.own_size)));
        for (k, landmark) in self.landmarks.iter().enumerate() {
            let row = self.own_size + 3 * k;
            f.view_mut((row, 0), (3, self.own_size)).copy_from(&landmark.by_state.columns(0, self.own_size));
            f.view_mut((row, row), (3, 3)).copy_from(&landmark.by_landmark);
        }
        f
    }

    /// G as one matrix of 9 columns.
    pub fn noise_matrix(&self) -> DMatrix<f64> {
        let mut g = DMatrix::zeros(self.own_size + 3 * self.landmarks.len(), BIASES);
        g.view_mut((0, 0), (BIASES, BIASES)).copy_from(&self.by_noise);
        for (k, landmark) in self.landmarks.iter().enumerate() {
            g.view_mut((self.own_size + 3 * k, 0), (3, 3)).copy_from(&landmark.by_rotation_noise);
        }
        g
    }
}
