//! What the filter estimates.

use crate::navigation::landing::inertial::ImuBiases;
use nalgebra::{DMatrix, Isometry3, UnitQuaternion, Vector3};

/// Start of the position's (or s̃'s) three components in the error state.
pub const POSITION: usize = 0;
/// Start of the velocity's.
pub const VELOCITY: usize = 3;
/// Start of the attitude's.
pub const ATTITUDE: usize = 6;
/// Start of the IMU biases', gyroscope first, where they are estimated; size of the lander's own error state.
pub const BIASES: usize = 9;
/// Components of the error state with biases and without landmarks.
pub const WITH_BIASES: usize = 15;

/// What a point of the state stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LandmarkRole {
    /// The surface point that a track shows.
    #[default]
    Point,
    /// Where the camera was at a track's first sight; the next landmark is its [`LandmarkRole::RayPoint`].
    RayOrigin,
    /// A point of the ray of a track's first sight, at a nominal distance.
    RayPoint,
}

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
    /// What it stands for.
    pub role: LandmarkRole,
}

impl UnknownLandmark {
    /// A surface point not observed yet but by what placed it.
    pub fn new(track_id: u64, position_in_site_m: Vector3<f64>, slot: usize) -> Self {
        UnknownLandmark { track_id, position_in_site_m, observations: 0, gated: 0, slot, role: LandmarkRole::Point }
    }
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
    /// Biases of the IMU, where they are estimated.
    pub biases: Option<ImuBiases>,
    /// The unknown landmarks p_i, in the order of the error state.
    pub landmarks: Vec<UnknownLandmark>,
}

impl DescentState {
    /// Components of the error state of the lander and its IMU: 9, or 15 with biases.
    pub fn own_size(&self) -> usize {
        if self.biases.is_some() { WITH_BIASES } else { BIASES }
    }

    /// Components of the whole error state: the lander's own and 3 a landmark.
    pub fn error_size(&self) -> usize {
        self.own_size() + 3 * self.landmarks.len()
    }

    /// Where landmark `index` starts in the error state.
    pub fn start_of(&self, index: usize) -> usize {
        self.own_size() + 3 * index
    }

    /// The lander's pose.
    pub fn site_from_lander(&self) -> Isometry3<f64> {
        Isometry3::from_parts(self.lander_in_site_m.into(), self.lander_from_site.inverse())
    }

    /// Index of the surface point that a track observes.
    pub fn landmark_of(&self, track_id: u64) -> Option<usize> {
        self.landmarks.iter().position(|l| l.track_id == track_id && l.role == LandmarkRole::Point)
    }
}

/// A state with the covariance of its error, in the coordinates of one [`FilterKind`](super::filter_kind::FilterKind).
#[derive(Debug, Clone, PartialEq)]
pub struct DescentEstimate {
    /// The estimated state.
    pub state: DescentState,
    /// Covariance, as large as the error state.
    pub covariance: DMatrix<f64>,
}
