//! What the filter estimates.

use nalgebra::{DMatrix, Isometry3, UnitQuaternion, Vector3};

/// Start of the position's (or s̃'s) three components in the error state.
pub(super) const POSITION: usize = 0;
/// Start of the velocity's.
pub(super) const VELOCITY: usize = 3;
/// Start of the attitude's.
pub(super) const ATTITUDE: usize = 6;
/// Start of the first unknown landmark's; size of the error state without landmarks.
pub(super) const LANDMARKS: usize = 9;

/// An unknown landmark that is being estimated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnknownLandmark {
    /// The image track that observes it.
    pub track_id: u64,
    /// Position in the site frame, m.
    pub position_in_site_m: Vector3<f64>,
    /// Accepted observations after the initialising one.
    pub observations: usize,
    /// Observations gated since the last accepted one.
    pub gated: usize,
    /// Which of the simultaneous landmarks it is, from 0.
    pub slot: usize,
}

/// State of the lander and of the unknown landmarks; the known landmark is the origin of the site frame.
#[derive(Debug, Clone, PartialEq)]
pub struct DescentState {
    /// Position r in the site frame, m.
    pub lander_in_site_m: Vector3<f64>,
    /// Velocity v in the site frame, m/s.
    pub lander_velocity_in_site_m_s: Vector3<f64>,
    /// Attitude; the paper's C(q).
    pub lander_from_site: UnitQuaternion<f64>,
    /// The unknown landmarks p_i, in the order of the error state.
    pub landmarks: Vec<UnknownLandmark>,
}

impl DescentState {
    /// Components of the error state: 9 and 3 a landmark.
    pub fn error_size(&self) -> usize {
        LANDMARKS + 3 * self.landmarks.len()
    }

    /// The lander's pose.
    pub fn site_from_lander(&self) -> Isometry3<f64> {
        Isometry3::from_parts(self.lander_in_site_m.into(), self.lander_from_site.inverse())
    }

    /// Index of the landmark that a track observes.
    pub fn landmark_of(&self, track_id: u64) -> Option<usize> {
        self.landmarks.iter().position(|l| l.track_id == track_id)
    }
}

/// A state with the covariance of its error, in the coordinates of one [`FilterKind`](super::FilterKind).
#[derive(Debug, Clone, PartialEq)]
pub struct DescentEstimate {
    /// The estimated state.
    pub state: DescentState,
    /// Covariance, as large as the error state.
    pub covariance: DMatrix<f64>,
}
