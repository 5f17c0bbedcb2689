//! The two choices of error coordinates behind one interface.

use super::state::{BIASES, DescentEstimate, DescentState, WITH_BIASES};
use super::{hybrid, standard};
use crate::navigation::landing::config::FilterKind;
use crate::navigation::landing::inertial::{ImuIncrement, Planet};
use crate::navigation::landing::propagation::Core;
use nalgebra::{DMatrix, Matrix3, SMatrix, Vector3};
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
    fn with_biases(mut self, increment: &ImuIncrement) -> Self {
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

/// Derivative of a vector in the filter's axes (3×n): by the position, the attitude and one landmark.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelativeJacobian {
    /// By the error of the position.
    pub by_position: Matrix3<f64>,
    /// By the error of the attitude.
    pub by_attitude: Matrix3<f64>,
    /// By the error of the landmark that is looked at, if it is one of the state's.
    pub by_landmark: Matrix3<f64>,
}

/// A point in space fixed by a ray from the camera, with its derivatives in the filter's axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RayPoint {
    /// Position in the site frame, m.
    pub position_in_site_m: Vector3<f64>,
    /// By the error of the position.
    pub by_position: Matrix3<f64>,
    /// By the error of the attitude.
    pub by_attitude: Matrix3<f64>,
    /// By the bearing's error, a small vector across the bearing in lander axes.
    pub by_bearing: Matrix3<f64>,
    /// By the height of the ground, where the ray ends on it.
    pub by_height: Vector3<f64>,
}

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
        let (_, depth_m) = crate::navigation::landing::bearings::ground_point(
            state,
            direction_in_lander,
            camera_in_lander_m,
            height_m,
        )?;
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
        (p + p.transpose()) * 0.5
    }
}

/// Three components of an error state.
pub(super) fn part(error: &[f64], start: usize) -> Vector3<f64> {
    Vector3::from_column_slice(&error[start..start + 3])
}
