//! The first estimate, and landmarks that come and go.

use crate::dataset::InitialState;
use crate::geometry::so3::tangent_basis;
use crate::navigation::landing::bearings::BearingObservation;
use crate::navigation::landing::config::LandingConfig;
use crate::navigation::landing::error_state::{
    ATTITUDE, BIASES, DescentEstimate, DescentState, FilterKind, LandmarkRole, POSITION, RayPoint, UnknownLandmark,
    WITH_BIASES,
};
use crate::navigation::landing::inertial::ImuBiases;
use crate::navigation::landmark::GroundPrior;
use crate::stats::symmetric;
use nalgebra::{DMatrix, Matrix3, Matrix3xX, SMatrix, Vector3};

/// The estimate before any image, its covariance carried into the filter's coordinates; with biases of 0 where the
/// options ask for them.
pub fn initial_estimate(initial: &InitialState, config: &LandingConfig) -> DescentEstimate {
    let mut state = DescentState {
        lander_in_site_m: initial.site_from_lander.translation.vector,
        lander_velocity_in_site_m_s: initial.lander_velocity_in_site_m_s,
        lander_from_site: initial.site_from_lander.rotation.inverse(),
        biases: None,
        landmarks: Vec::new(),
    };
    let mut site = SMatrix::<f64, 9, 9>::zeros();
    for (k, sigma) in
        [initial.sigma_position_m, initial.sigma_velocity_m_s, initial.sigma_attitude_rad].iter().enumerate()
    {
        site.fixed_view_mut::<3, 3>(3 * k, 3 * k).fill_diagonal(sigma * sigma);
    }
    let from_site = config.filter.site_jacobian(&state).try_inverse().expect("a change of coordinates is invertible");
    let lander = from_site * site * from_site.transpose();
    let mut covariance = DMatrix::from_column_slice(BIASES, BIASES, lander.as_slice());
    if let Some(biases) = &config.biases {
        state.biases = Some(ImuBiases::default());
        covariance = covariance.resize(WITH_BIASES, WITH_BIASES, 0.0);
        for k in 0..3 {
            covariance[(BIASES + k, BIASES + k)] = biases.sigma_gyroscope_rad_s.powi(2);
            covariance[(BIASES + 3 + k, BIASES + 3 + k)] = biases.sigma_accelerometer_m_s2.powi(2);
        }
    }
    DescentEstimate { state, covariance }
}

/// The estimate with an unknown landmark on the ground plane where a bearing meets it, correlated in full with the
/// state, and its height uncertain as the ground prior says. The bearing is consumed: it must not be used again. `None`
/// if the bearing meets the ground nowhere, or too far off nadir.
pub fn with_landmark(
    estimate: &DescentEstimate,
    bearing: &BearingObservation,
    slot: usize,
    site: &InitializationModel,
) -> Option<DescentEstimate> {
    with_landmark_at_height(estimate, bearing, (slot, 0.0), site)
}

/// [`with_landmark`] at a mean height of the ground (m) that is not 0.
pub fn with_landmark_at_height(
    estimate: &DescentEstimate,
    bearing: &BearingObservation,
    (slot, height_m): (usize, f64),
    site: &InitializationModel,
) -> Option<DescentEstimate> {
    let z = bearing.direction_in_lander.into_inner();
    let new = site.kind.point_on_ground(&estimate.state, &z, &site.camera_in_lander_m, height_m)?;
    let relative_m = new.position_in_site_m - estimate.state.lander_in_site_m;
    if relative_m.angle(&-Vector3::z()) > site.ground.largest_off_nadir_rad {
        return None;
    }
    // The ground point lies on the plane, so that the trace is the variance of its horizontal position.
    let rows = rows_of(&estimate.covariance, &new);
    let variance_m2 = corner_of(&rows, &new).trace();
    let distance_m = (new.position_in_site_m.xy().norm_squared() + variance_m2).sqrt();
    let height = new.by_height * site.ground.sigma_at_distance_m(distance_m);
    let own = bearing_noise(&new, bearing) + height * height.transpose();
    let landmark = UnknownLandmark::new(bearing.track_id, new.position_in_site_m, slot);
    Some(augmented(estimate, landmark, &new, &own))
}

/// Constants of an initialisation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InitializationModel {
    /// Coordinates of the error.
    pub kind: FilterKind,
    /// Position of the camera in lander axes, m.
    pub camera_in_lander_m: Vector3<f64>,
    /// What is known of the ground.
    pub ground: GroundPrior,
}

/// J P, the covariance of a new point with the state.
fn rows_of(covariance: &DMatrix<f64>, new: &RayPoint) -> Matrix3xX<f64> {
    new.by_position * covariance.fixed_rows::<3>(POSITION) + new.by_attitude * covariance.fixed_rows::<3>(ATTITUDE)
}

/// J P Jᵀ.
fn corner_of(rows: &Matrix3xX<f64>, new: &RayPoint) -> Matrix3<f64> {
    rows.fixed_view::<3, 3>(0, POSITION) * new.by_position.transpose()
        + rows.fixed_view::<3, 3>(0, ATTITUDE) * new.by_attitude.transpose()
}

/// What the noise of its bearing does to a point.
pub(super) fn bearing_noise(new: &RayPoint, bearing: &BearingObservation) -> Matrix3<f64> {
    let across = new.by_bearing * tangent_basis(&bearing.direction_in_lander);
    across * bearing.covariance_rad2 * across.transpose()
}

/// `[P, P Jᵀ; J P, J P Jᵀ + own]`, with the point appended to the state.
pub(super) fn augmented(
    estimate: &DescentEstimate,
    landmark: UnknownLandmark,
    new: &RayPoint,
    own: &Matrix3<f64>,
) -> DescentEstimate {
    let n = estimate.covariance.nrows();
    let rows = rows_of(&estimate.covariance, new);
    let corner = corner_of(&rows, new) + own;
    let mut all = estimate.covariance.clone().resize(n + 3, n + 3, 0.0);
    all.view_mut((n, 0), (3, n)).copy_from(&rows);
    all.view_mut((0, n), (n, 3)).copy_from(&rows.transpose());
    all.fixed_view_mut::<3, 3>(n, n).copy_from(&symmetric(&corner));
    let mut state = estimate.state.clone();
    state.landmarks.push(landmark);
    DescentEstimate { state, covariance: all }
}

/// The estimate without one of its landmarks, which is marginalised; a ray goes with both of its points.
pub fn without_landmark(estimate: &DescentEstimate, index: usize) -> DescentEstimate {
    let (first, count) = match estimate.state.landmarks[index].role {
        LandmarkRole::Point => (index, 1),
        LandmarkRole::RayOrigin => (index, 2),
        LandmarkRole::RayPoint => (index - 1, 2),
    };
    let start = estimate.state.start_of(first);
    let mut state = estimate.state.clone();
    state.landmarks.drain(first..first + count);
    let covariance = estimate.covariance.clone().remove_rows(start, 3 * count).remove_columns(start, 3 * count);
    DescentEstimate { state, covariance }
}
