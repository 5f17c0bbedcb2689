//! Correction by the bearings of one image.

use super::measurement::BearingObservation;
use super::{DescentEstimate, DescentState, FilterKind};
use crate::geometry::so3::tangent_basis;
use crate::navigation::filter::{Gate, Innovation, iterated_correction};
use crate::navigation::landmark::projector_over_range;
use crate::vision::TrackObservation;
use nalgebra::{DMatrix, DVector, Matrix2, Matrix3, Vector3};

/// What became of one bearing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outcome {
    /// The track.
    pub track_id: u64,
    /// Normalised innovation squared, 2 degrees of freedom; infinite where the prediction points away.
    pub normalized_innovation_squared: f64,
    /// Whether it was used; otherwise it was gated.
    pub used: bool,
}

/// An estimate after the bearings of one image.
#[derive(Debug, Clone, PartialEq)]
pub struct Corrected {
    /// The estimate; unchanged but for the landmarks' counts if nothing was used.
    pub estimate: DescentEstimate,
    /// One entry for each bearing of the known landmark and of the state's unknown ones.
    pub outcomes: Vec<Outcome>,
    /// Joint normalised innovation squared of what was used.
    pub normalized_innovation_squared: Option<f64>,
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
}

/// The estimate after one image: equations (11) to (18) of Li et al. 2023, each bearing gated by itself, the rest used
/// together. Bearings of other tracks are left alone. `None` if the covariance is no longer positive definite.
pub fn correct(
    estimate: &DescentEstimate,
    bearings: &[BearingObservation],
    model: &CorrectionModel,
) -> Option<Corrected> {
    let mut accepted = Vec::new();
    let mut outcomes = Vec::new();
    for bearing in bearings.iter().filter(|b| is_modelled(&estimate.state, b.track_id)) {
        let noise = noise_with_second_order(estimate, bearing, model);
        let innovation = innovation(&estimate.state, bearing, &noise, model);
        let nis = match innovation {
            Some(innovation) => innovation.normalized_squared(&estimate.covariance)?,
            None => f64::INFINITY,
        };
        let used = model.gate.passes(nis, 2);
        outcomes.push(Outcome { track_id: bearing.track_id, normalized_innovation_squared: nis, used });
        if used {
            accepted.push((*bearing, noise));
        }
    }
    if accepted.is_empty() {
        let state = counted(estimate.state.clone(), &outcomes);
        let estimate = DescentEstimate { state, covariance: estimate.covariance.clone() };
        return Some(Corrected { estimate, outcomes, normalized_innovation_squared: None });
    }
    let linearize = |error: &DVector<f64>| stacked(estimate, error, &accepted, model);
    let correction = iterated_correction(&estimate.covariance, model.iterations, linearize)?;
    let state = counted(model.kind.retract(&estimate.state, &correction.shift), &outcomes);
    Some(Corrected {
        estimate: DescentEstimate { state, covariance: correction.covariance },
        outcomes,
        normalized_innovation_squared: Some(correction.normalized_innovation_squared),
    })
}

fn is_modelled(state: &DescentState, track_id: u64) -> bool {
    track_id == TrackObservation::DESIGNATED || state.landmark_of(track_id).is_some()
}

/// Position of a bearing's landmark relative to the camera, lander axes, m.
fn relative_in_lander_m(state: &DescentState, landmark: Option<usize>, model: &CorrectionModel) -> Vector3<f64> {
    let position_m = landmark.map_or(Vector3::zeros(), |k| state.landmarks[k].position_in_site_m);
    state.lander_from_site * (position_m - state.lander_in_site_m) - model.camera_in_lander_m
}

/// Innovation of one bearing across its measured direction: equations (12) and (14); `None` where the prediction points
/// away from the measurement or the landmark is at the camera.
pub fn innovation(
    state: &DescentState,
    bearing: &BearingObservation,
    noise_rad2: &Matrix2<f64>,
    model: &CorrectionModel,
) -> Option<Innovation> {
    let landmark = state.landmark_of(bearing.track_id);
    let relative_m = relative_in_lander_m(state, landmark, model);
    let predicted = relative_m.try_normalize(1e-3)?;
    if predicted.dot(&bearing.direction_in_lander) <= 0.0 {
        return None;
    }
    let across = tangent_basis(&bearing.direction_in_lander).transpose();
    let residual = -(across * predicted);
    let by_relative = across * projector_over_range(&relative_m);
    let jacobian = by_relative * model.kind.relative_jacobian(state, landmark);
    Some(Innovation {
        residual: DVector::from_column_slice(residual.as_slice()),
        jacobian: DMatrix::from_column_slice(2, jacobian.ncols(), jacobian.as_slice()),
        noise: DMatrix::from_column_slice(2, 2, noise_rad2.as_slice()),
    })
}

/// Bearing noise and what the curvature of the bearing adds: a depth error e∥ and an error across e⊥ leave
/// e∥ e⊥ / ρ² unmodelled, with covariance (σ∥² P⊥ + c cᵀ) / ρ⁴ for Gaussian errors, c = cov(e∥, e⊥).
fn noise_with_second_order(
    estimate: &DescentEstimate,
    bearing: &BearingObservation,
    model: &CorrectionModel,
) -> Matrix2<f64> {
    let landmark = estimate.state.landmark_of(bearing.track_id);
    let relative_m = relative_in_lander_m(&estimate.state, landmark, model);
    let j = model.kind.relative_jacobian(&estimate.state, landmark);
    let dynamic = &j * &estimate.covariance * j.transpose();
    let covariance = Matrix3::from_column_slice(dynamic.as_slice());
    let across = tangent_basis(&bearing.direction_in_lander).transpose();
    let along = bearing.direction_in_lander.into_inner();
    let variance_along = along.dot(&(covariance * along));
    let mixed = across * covariance * along;
    let second = (across * covariance * across.transpose() * variance_along + mixed * mixed.transpose())
        / relative_m.norm_squared().max(1e-6).powi(2);
    bearing.covariance_rad2 + second
}

/// Innovation of every accepted bearing at the estimate moved by `error`; one that points away there adds nothing.
fn stacked(
    estimate: &DescentEstimate,
    error: &DVector<f64>,
    accepted: &[(BearingObservation, Matrix2<f64>)],
    model: &CorrectionModel,
) -> Innovation {
    let state = model.kind.retract(&estimate.state, error);
    let empty = Innovation {
        residual: DVector::zeros(2),
        jacobian: DMatrix::zeros(2, state.error_size()),
        noise: DMatrix::identity(2, 2),
    };
    let parts: Vec<Innovation> = accepted
        .iter()
        .map(|(bearing, noise)| innovation(&state, bearing, noise, model).unwrap_or_else(|| empty.clone()))
        .collect();
    Innovation::stacked(&parts).unwrap_or(empty)
}

/// The landmarks' counts after an image.
fn counted(mut state: DescentState, outcomes: &[Outcome]) -> DescentState {
    for outcome in outcomes {
        if let Some(k) = state.landmark_of(outcome.track_id) {
            let landmark = &mut state.landmarks[k];
            landmark.observations += usize::from(outcome.used);
            landmark.gated = if outcome.used { 0 } else { landmark.gated + 1 };
        }
    }
    state
}
