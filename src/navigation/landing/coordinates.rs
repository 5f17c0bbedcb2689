//! The two choices of error coordinates behind one interface.

use super::imu::ImuIncrement;
use super::measurement::BearingObservation;
use super::state::LANDMARKS;
use super::{DescentEstimate, DescentState, FilterKind, hybrid, standard};
use nalgebra::{DMatrix, DVector, Matrix3, SMatrix, Vector3};

/// Linearised motion of the error state: `e_j = F e_i + G n`, with the increment's noise n (9).
#[derive(Debug, Clone, PartialEq)]
pub struct Transition {
    /// F, as large as the error state.
    pub by_state: DMatrix<f64>,
    /// G, 9 columns.
    pub by_noise: DMatrix<f64>,
}

/// Derivatives of a landmark initialised on the ground plane.
#[derive(Debug, Clone, PartialEq)]
pub struct LandmarkJacobians {
    /// Position in the site frame, m.
    pub position_in_site_m: Vector3<f64>,
    /// Derivative of its error by the error state (3×n).
    pub by_state: DMatrix<f64>,
    /// Derivative by the bearing's error, a small vector across the bearing in lander axes.
    pub by_bearing: Matrix3<f64>,
    /// Derivative by the ground's height.
    pub by_height: Vector3<f64>,
}

impl FilterKind {
    /// The state moved by an error.
    pub fn retract(self, state: &DescentState, error: &DVector<f64>) -> DescentState {
        match self {
            FilterKind::Hybrid => hybrid::retract(state, error),
            FilterKind::Standard => standard::retract(state, error),
        }
    }

    /// Motion of the error between two states that an increment joins under gravity (site frame, m/s²).
    pub fn transition(
        self,
        before: &DescentState,
        after: &DescentState,
        increment: &ImuIncrement,
        gravity_in_site_m_s2: &Vector3<f64>,
    ) -> Transition {
        match self {
            FilterKind::Hybrid => hybrid::transition(before, after, increment, gravity_in_site_m_s2),
            FilterKind::Standard => standard::transition(before, after, increment, gravity_in_site_m_s2),
        }
    }

    /// Derivative (3×n) of a landmark's position relative to the lander, in lander axes, by the error state; `None` for
    /// the known landmark.
    pub fn relative_jacobian(self, state: &DescentState, landmark: Option<usize>) -> DMatrix<f64> {
        match self {
            FilterKind::Hybrid => hybrid::relative_jacobian(state, landmark),
            FilterKind::Standard => standard::relative_jacobian(state, landmark),
        }
    }

    /// The landmark that a bearing meets on the ground at `height_m` above the plane z = 0, seen by a camera at
    /// `camera_in_lander_m`; `None` if it does not look down.
    pub fn landmark_on_ground(
        self,
        state: &DescentState,
        bearing: &BearingObservation,
        camera_in_lander_m: &Vector3<f64>,
        height_m: f64,
    ) -> Option<LandmarkJacobians> {
        match self {
            FilterKind::Hybrid => hybrid::landmark_on_ground(state, bearing, camera_in_lander_m, height_m),
            FilterKind::Standard => standard::landmark_on_ground(state, bearing, camera_in_lander_m, height_m),
        }
    }

    /// Derivative (9×9) of the errors of position, velocity and attitude ψ in site axes by the lander's error state.
    pub fn site_jacobian(self, state: &DescentState) -> SMatrix<f64, 9, 9> {
        match self {
            FilterKind::Hybrid => hybrid::site_jacobian(state),
            FilterKind::Standard => standard::site_jacobian(state),
        }
    }

    /// Covariance of the errors of position (m), velocity (m/s) and attitude ψ (rad), all in site axes, where
    /// `true site_from_lander = exp(ψ) * estimated`; of second order in the errors where the change of coordinates is
    /// not linear.
    pub fn site_covariance(self, estimate: &DescentEstimate) -> SMatrix<f64, 9, 9> {
        let j = self.site_jacobian(&estimate.state);
        let lander = estimate.covariance.fixed_view::<LANDMARKS, LANDMARKS>(0, 0).into_owned();
        let mut p = j * lander * j.transpose();
        if self == FilterKind::Hybrid {
            p += hybrid::site_second_moment(&estimate.state, &lander);
        }
        (p + p.transpose()) * 0.5
    }
}
