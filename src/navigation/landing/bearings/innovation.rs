//! The bearing of one point, linearised at an estimate.

use super::measurement::BearingObservation;
use crate::geometry::so3::tangent_basis;
use crate::navigation::filter::{Gate, Innovation, QuadraticMoments};
use crate::navigation::landing::error_state::{
    ATTITUDE, DescentEstimate, DescentState, FilterKind, POSITION, RelativeJacobian,
};
use crate::navigation::landmark::projector_over_range;
use crate::stats::symmetric;
use nalgebra::{Matrix2, Matrix3, Vector3};
use smallvec::smallvec;

/// The linearised bearing of one point, across its measured direction (rad): equations (12) and (14). The Jacobian has a
/// block for the position, one for the attitude, and one for the landmark if that is the state's.
pub type BearingInnovation = Innovation<2, 3>;

/// A point as one bearing sees it.
struct LineOfSight {
    landmark: Option<usize>,
    relative_in_lander_m: Vector3<f64>,
    jacobian: RelativeJacobian,
}

fn sight(state: &DescentState, bearing: &BearingObservation, model: &CorrectionModel) -> LineOfSight {
    let landmark = if bearing.known.is_some() { None } else { state.landmark_of(bearing.track_id) };
    let point_m = match (&bearing.known, landmark) {
        (Some(known), _) => known.position_in_site_m,
        (None, Some(k)) => state.landmarks[k].position_in_site_m,
        (None, None) => Vector3::zeros(),
    };
    LineOfSight {
        landmark,
        relative_in_lander_m: state.lander_from_site * (point_m - state.lander_in_site_m) - model.camera_in_lander_m,
        jacobian: model.kind.relative_jacobian(state, &point_m, landmark.is_some()),
    }
}

/// Innovation of one bearing with a given noise; `None` where the prediction points away from the measurement or the
/// landmark is at the camera.
pub fn innovation(
    state: &DescentState,
    bearing: &BearingObservation,
    noise_rad2: &Matrix2<f64>,
    model: &CorrectionModel,
) -> Option<BearingInnovation> {
    linearized(state, bearing, noise_rad2, &sight(state, bearing, model))
}

fn linearized(
    state: &DescentState,
    bearing: &BearingObservation,
    noise: &Matrix2<f64>,
    sight: &LineOfSight,
) -> Option<BearingInnovation> {
    let predicted = sight.relative_in_lander_m.try_normalize(1e-3)?;
    if predicted.dot(&bearing.direction_in_lander) <= 0.0 {
        return None;
    }
    let across = tangent_basis(&bearing.direction_in_lander).transpose();
    let by_relative = across * projector_over_range(&sight.relative_in_lander_m);
    let j = &sight.jacobian;
    let known = bearing.known.map_or(0.0, |point| point.sigma_m.powi(2));
    let mut jacobian = smallvec![(POSITION, by_relative * j.by_position), (ATTITUDE, by_relative * j.by_attitude)];
    jacobian.extend(sight.landmark.map(|k| (state.start_of(k), by_relative * j.by_landmark)));
    Some(BearingInnovation {
        residual: -(across * predicted),
        jacobian,
        noise: noise + by_relative * by_relative.transpose() * known,
    })
}

/// The innovation with the bearing's own noise and what its curvature adds.
pub(super) fn innovation_of(
    estimate: &DescentEstimate,
    bearing: &BearingObservation,
    model: &CorrectionModel,
) -> Option<BearingInnovation> {
    let sight = sight(&estimate.state, bearing, model);
    let mut noise = bearing.covariance_rad2;
    if model.second_order {
        noise += second_order(estimate, bearing, &sight);
    }
    linearized(&estimate.state, bearing, &noise, &sight)
}

/// What the curvature of the bearing adds to its noise: a depth error e∥ and an error across e⊥ leave -e∥ e⊥ / ρ²
/// unmodelled. Its mean, which their correlation brings, is left where it is.
fn second_order(estimate: &DescentEstimate, bearing: &BearingObservation, sight: &LineOfSight) -> Matrix2<f64> {
    let across = tangent_basis(&bearing.direction_in_lander);
    let along = bearing.direction_in_lander.into_inner();
    let range_squared_m2 = sight.relative_in_lander_m.norm_squared().max(1e-6);
    let hessian = |axis: usize| symmetric(&(across.column(axis) * along.transpose())) * (-2.0 / range_squared_m2);
    QuadraticMoments::new(&[hessian(0), hessian(1)], &relative_covariance(estimate, sight)).covariance
}

/// Covariance of the point's position relative to the lander, lander axes, m².
fn relative_covariance(estimate: &DescentEstimate, sight: &LineOfSight) -> Matrix3<f64> {
    let j = &sight.jacobian;
    let landmark = sight.landmark.map(|k| (estimate.state.start_of(k), j.by_landmark));
    let blocks = [Some((POSITION, j.by_position)), Some((ATTITUDE, j.by_attitude)), landmark];
    let mut total = Matrix3::zeros();
    for (row, left) in blocks.iter().flatten() {
        for (column, right) in blocks.iter().flatten() {
            total += left * estimate.covariance.fixed_view::<3, 3>(*row, *column) * right.transpose();
        }
    }
    total
}

/// Constants of a correction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CorrectionModel {
    /// Coordinates of the error.
    pub kind: FilterKind,
    /// Innovation gate.
    pub gate: Gate,
    /// Gauss–Newton steps.
    pub iterations: usize,
    /// Position of the camera in lander axes, m.
    pub camera_in_lander_m: Vector3<f64>,
    /// Whether the noise of a bearing counts what its curvature leaves unmodelled.
    pub second_order: bool,
}
