//! The two choices of error coordinates behind one interface.

use super::filter_kind::FilterKind;
use super::jacobian::{RayPoint, RelativeJacobian, part};
use super::state::{BIASES, DescentEstimate, DescentState};
use super::state_core::Core;
use super::transition::Transition;
use super::{hybrid, standard};
use crate::navigation::landing::inertial::{ImuIncrement, Planet};
use crate::stats::symmetric;
use nalgebra::{SMatrix, Vector3};

impl FilterKind {
    /// The state moved by an error.
    pub fn retract(self, state: DescentState, error: &[f64]) -> DescentState {
        let mut moved = match self {
            FilterKind::Hybrid => hybrid::retract(state, error),
            FilterKind::Standard => standard::retract(state, error),
        };
        if let Some(biases) = &mut moved.biases {
            biases.gyroscope_rad_s += part(error, BIASES);
            biases.accelerometer_m_s2 += part(error, BIASES + 3);
        }
        moved
    }

    /// Motion of the error from a state to the one that an increment leads to.
    pub fn transition(
        self,
        before: &Core,
        after: &DescentState,
        increment: &ImuIncrement,
        planet: &Planet,
    ) -> Transition {
        let transition = match self {
            FilterKind::Hybrid => hybrid::transition(before, after, increment, planet),
            FilterKind::Standard => standard::transition(before, after, increment, planet),
        };
        if after.biases.is_some() { transition.with_biases(increment) } else { transition }
    }

    /// Derivative of a point's position relative to the lander, in lander axes; the point is at `point_in_site_m`, and
    /// either one of the state's landmarks or known.
    pub fn relative_jacobian(
        self,
        state: &DescentState,
        point_in_site_m: &Vector3<f64>,
        is_state: bool,
    ) -> RelativeJacobian {
        match self {
            FilterKind::Hybrid => hybrid::relative_jacobian(state, point_in_site_m, is_state),
            FilterKind::Standard => standard::relative_jacobian(state, point_in_site_m, is_state),
        }
    }

    /// The point at the end of `arm_in_lander_m`, whose last `reach_m` are along a bearing.
    pub fn point_of_arm(self, state: &DescentState, arm_in_lander_m: &Vector3<f64>, reach_m: f64) -> RayPoint {
        match self {
            FilterKind::Hybrid => hybrid::point_of_arm(state, arm_in_lander_m, reach_m),
            FilterKind::Standard => standard::point_of_arm(state, arm_in_lander_m, reach_m),
        }
    }

    /// The point where a ray from the camera (at `camera_in_lander_m`) meets the ground at `height_m` above the plane
    /// z = 0; `None` if it does not look down.
    pub fn point_on_ground(
        self,
        state: &DescentState,
        direction_in_lander: &Vector3<f64>,
        camera_in_lander_m: &Vector3<f64>,
        height_m: f64,
    ) -> Option<RayPoint> {
        let (_, depth_m) = super::ground_point::ground_point(state, direction_in_lander, camera_in_lander_m, height_m)?;
        let free = self.point_of_arm(state, &(camera_in_lander_m + direction_in_lander * depth_m), depth_m);
        Some(match self {
            FilterKind::Hybrid => hybrid::kept_on_ground(state, free, direction_in_lander),
            FilterKind::Standard => standard::kept_on_ground(state, free, direction_in_lander),
        })
    }

    /// A vector of the site frame in the axes of the errors of position, velocity and landmarks.
    pub(in crate::navigation::landing) fn in_error_axes(
        self,
        state: &DescentState,
        vector_in_site: &Vector3<f64>,
    ) -> Vector3<f64> {
        match self {
            FilterKind::Hybrid => state.lander_from_site * vector_in_site,
            FilterKind::Standard => *vector_in_site,
        }
    }

    /// A vector of lander axes in the axes of the errors of position, velocity and landmarks.
    pub(in crate::navigation::landing) fn lander_in_error_axes(
        self,
        state: &DescentState,
        vector_in_lander: &Vector3<f64>,
    ) -> Vector3<f64> {
        match self {
            FilterKind::Hybrid => *vector_in_lander,
            FilterKind::Standard => state.lander_from_site.inverse() * vector_in_lander,
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
        let lander = estimate.covariance.fixed_view::<BIASES, BIASES>(0, 0).into_owned();
        let mut p = j * lander * j.transpose();
        if self == FilterKind::Hybrid {
            p += hybrid::site_second_moment(&estimate.state, &lander);
        }
        symmetric(&p)
    }
}
