//! The first estimate, and landmarks that come and go.

use super::coordinates::LandmarkJacobians;
use super::measurement::BearingObservation;
use super::state::LANDMARKS;
use super::{DescentEstimate, DescentState, FilterKind, UnknownLandmark};
use crate::dataset::InitialState;
use crate::geometry::so3::tangent_basis;
use crate::navigation::landmark::GroundPrior;
use nalgebra::{DMatrix, SMatrix, Vector3};

/// The estimate before any image, its covariance carried into the filter's coordinates.
pub fn initial_estimate(initial: &InitialState, kind: FilterKind) -> DescentEstimate {
    let state = DescentState {
        lander_in_site_m: initial.site_from_lander.translation.vector,
        lander_velocity_in_site_m_s: initial.lander_velocity_in_site_m_s,
        lander_from_site: initial.site_from_lander.rotation.inverse(),
        landmarks: Vec::new(),
    };
    let mut site = SMatrix::<f64, 9, 9>::zeros();
    for (k, sigma) in
        [initial.sigma_position_m, initial.sigma_velocity_m_s, initial.sigma_attitude_rad].iter().enumerate()
    {
        site.fixed_view_mut::<3, 3>(3 * k, 3 * k).fill_diagonal(sigma * sigma);
    }
    let from_site = kind.site_jacobian(&state).try_inverse().expect("a change of coordinates is invertible");
    let lander = from_site * site * from_site.transpose();
    DescentEstimate { state, covariance: DMatrix::from_column_slice(LANDMARKS, LANDMARKS, lander.as_slice()) }
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
    let kind = site.kind;
    let new = kind.landmark_on_ground(&estimate.state, bearing, &site.camera_in_lander_m, 0.0)?;
    let relative_m = new.position_in_site_m - estimate.state.lander_in_site_m;
    if relative_m.angle(&-Vector3::z()) > site.ground.largest_off_nadir_rad {
        return None;
    }
    let mut state = estimate.state.clone();
    state.landmarks.push(UnknownLandmark {
        track_id: bearing.track_id,
        position_in_site_m: new.position_in_site_m,
        observations: 0,
        gated: 0,
        slot,
    });
    let covariance = augmented(&estimate.covariance, &new, bearing, &site.ground);
    Some(DescentEstimate { state, covariance })
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

/// `[P, P Jᵀ; J P, J P Jᵀ + noise of the bearing + noise of the height]`.
fn augmented(
    covariance: &DMatrix<f64>,
    new: &LandmarkJacobians,
    bearing: &BearingObservation,
    ground: &GroundPrior,
) -> DMatrix<f64> {
    let n = covariance.nrows();
    let across = new.by_bearing * tangent_basis(&bearing.direction_in_lander);
    let cross = &new.by_state * covariance;
    let corner = &cross * new.by_state.transpose();
    // The ground point lies on the plane, so that this is the variance of its horizontal position.
    let variance_m2 = corner.trace();
    let distance_m = (new.position_in_site_m.xy().norm_squared() + variance_m2).sqrt();
    let height = new.by_height * ground.sigma_at_distance_m(distance_m);
    let own = across * bearing.covariance_rad2 * across.transpose() + height * height.transpose();
    let mut all = covariance.clone().resize(n + 3, n + 3, 0.0);
    all.view_mut((n, 0), (3, n)).copy_from(&cross);
    all.view_mut((0, n), (n, 3)).copy_from(&cross.transpose());
    all.view_mut((n, n), (3, 3)).copy_from(&(&corner + own));
    (&all + all.transpose()) * 0.5
}

/// The estimate without one of its landmarks, which is marginalised.
pub fn without_landmark(estimate: &DescentEstimate, index: usize) -> DescentEstimate {
    let mut state = estimate.state.clone();
    state.landmarks.remove(index);
    let start = LANDMARKS + 3 * index;
    let covariance = estimate.covariance.clone().remove_rows(start, 3).remove_columns(start, 3);
    DescentEstimate { state, covariance }
}
