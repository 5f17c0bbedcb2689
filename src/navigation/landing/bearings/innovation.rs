//! The bearing of one point, linearised at an estimate.

use super::measurement::BearingObservation;
use crate::geometry::so3::tangent_basis;
use crate::navigation::filter::{Gate, Innovation};
use crate::navigation::landing::error_state::{
    ATTITUDE, DescentEstimate, DescentState, FilterKind, LARGEST, POSITION, RelativeJacobian,
};
use crate::navigation::landmark::projector_over_range;
use crate::stats::symmetric;
use nalgebra::{DMatrix, DVector, Matrix2, Matrix2x3, Matrix3, Vector2, Vector3};

/// The linearised bearing of one point, across its measured direction: equations (12) and (14). The derivatives are in
/// blocks of three columns of the error state; all others are 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BearingInnovation {
    /// Measured less predicted, rad.
    pub residual: Vector2<f64>,
    /// By the position.
    pub by_position: Matrix2x3<f64>,
    /// By the attitude.
    pub by_attitude: Matrix2x3<f64>,
    /// By the landmark, and where that starts in the error state.
    pub by_landmark: Option<(usize, Matrix2x3<f64>)>,
    /// Covariance of the bearing's noise, rad².
    pub noise: Matrix2<f64>,
}

impl BearingInnovation {
    /// The same with a dense Jacobian of `columns` columns.
    pub fn dense(&self, columns: usize) -> Innovation {
        let mut jacobian = DMatrix::zeros(2, columns);
        jacobian.fixed_view_mut::<2, 3>(0, POSITION).copy_from(&self.by_position);
        jacobian.fixed_view_mut::<2, 3>(0, ATTITUDE).copy_from(&self.by_attitude);
        if let Some((start, block)) = &self.by_landmark {
            jacobian.fixed_view_mut::<2, 3>(0, *start).copy_from(block);
        }
        Innovation {
            residual: DVector::from_column_slice(self.residual.as_slice()),
            jacobian,
            noise: DMatrix::from_column_slice(2, 2, self.noise.as_slice()),
        }
    }

    pub(super) fn blocks(&self) -> impl Iterator<Item = (usize, &Matrix2x3<f64>)> {
        let landmark = self.by_landmark.as_ref().map(|(start, block)| (*start, block));
        [(POSITION, &self.by_position), (ATTITUDE, &self.by_attitude)].into_iter().chain(landmark)
    }

    /// H x for a column x of the error state.
    pub(super) fn times(&self, column: &[f64]) -> Vector2<f64> {
        self.blocks().map(|(start, block)| block * Vector3::from_column_slice(&column[start..start + 3])).sum()
    }

    /// (P Hᵀ)ᵀ = H P, a pair a column of P.
    pub(super) fn times_covariance(&self, p: &DMatrix<f64>, pairs: &mut [Vector2<f64>; LARGEST]) {
        for (pair, column) in pairs.iter_mut().zip(p.column_iter()) {
            *pair = self.times(column.as_slice());
        }
    }

    /// H P Hᵀ + R.
    pub(super) fn covariance(&self, pairs: &[Vector2<f64>; LARGEST]) -> Matrix2<f64> {
        let mut s = self.noise;
        for (start, block) in self.blocks() {
            s += Matrix2x3::from_columns(&[pairs[start], pairs[start + 1], pairs[start + 2]]) * block.transpose();
        }
        symmetric(&s)
    }
}

/// A point as one bearing sees it.
struct Sight {
    landmark: Option<usize>,
    relative_in_lander_m: Vector3<f64>,
    jacobian: RelativeJacobian,
}

fn sight(state: &DescentState, bearing: &BearingObservation, model: &CorrectionModel) -> Sight {
    let landmark = if bearing.known.is_some() { None } else { state.landmark_of(bearing.track_id) };
    let point_m = match (&bearing.known, landmark) {
        (Some(known), _) => known.position_in_site_m,
        (None, Some(k)) => state.landmarks[k].position_in_site_m,
        (None, None) => Vector3::zeros(),
    };
    Sight {
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
    sight: &Sight,
) -> Option<BearingInnovation> {
    let predicted = sight.relative_in_lander_m.try_normalize(1e-3)?;
    if predicted.dot(&bearing.direction_in_lander) <= 0.0 {
        return None;
    }
    let across = tangent_basis(&bearing.direction_in_lander).transpose();
    let by_relative = across * projector_over_range(&sight.relative_in_lander_m);
    let j = &sight.jacobian;
    let known = bearing.known.map_or(0.0, |point| point.sigma_m.powi(2));
    Some(BearingInnovation {
        residual: -(across * predicted),
        by_position: by_relative * j.by_position,
        by_attitude: by_relative * j.by_attitude,
        by_landmark: sight.landmark.map(|k| (state.start_of(k), by_relative * j.by_landmark)),
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

/// What the curvature of the bearing adds to its noise: a depth error e∥ and an error across e⊥ leave e∥ e⊥ / ρ²
/// unmodelled, with covariance (σ∥² P⊥ + c cᵀ) / ρ⁴ for Gaussian errors, c = cov(e∥, e⊥).
fn second_order(estimate: &DescentEstimate, bearing: &BearingObservation, sight: &Sight) -> Matrix2<f64> {
    let covariance = relative_covariance(estimate, sight);
    let across = tangent_basis(&bearing.direction_in_lander).transpose();
    let along = bearing.direction_in_lander.into_inner();
    let variance_along = along.dot(&(covariance * along));
    let mixed = across * covariance * along;
    (across * covariance * across.transpose() * variance_along + mixed * mixed.transpose())
        / sight.relative_in_lander_m.norm_squared().max(1e-6).powi(2)
}

/// Covariance of the point's position relative to the lander, lander axes, m².
fn relative_covariance(estimate: &DescentEstimate, sight: &Sight) -> Matrix3<f64> {
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
