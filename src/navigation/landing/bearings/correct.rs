//! Correction by the bearings of one image.

use super::innovation::{BearingInnovation, CorrectionModel, innovation, innovation_of};
use super::measurement::{BearingObservation, KnownPoint};
use crate::navigation::filter::{correction, iterated_correction};
use crate::navigation::landing::error_state::{DescentEstimate, DescentState};
use crate::observations::TrackObservation;
use nalgebra::Vector2;
use smallvec::SmallVec;

/// What became of one bearing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outcome {
    /// The track.
    pub track_id: u64,
    /// Whether its place was known from a map.
    pub known: bool,
    /// Normalised innovation squared, 2 degrees of freedom; infinite where the prediction points away.
    pub normalized_innovation_squared: f64,
    /// Whether it was used; otherwise it was gated.
    pub used: bool,
}

/// What became of the bearings of an image.
pub type Outcomes = SmallVec<[Outcome; 8]>;

/// An estimate after the bearings of one image.
#[derive(Debug, Clone, PartialEq)]
pub struct Corrected {
    /// The estimate; unchanged but for the landmarks' counts if nothing was used.
    pub estimate: DescentEstimate,
    /// One entry for each bearing of a known point and of the state's unknown ones.
    pub outcomes: Outcomes,
    /// Joint normalised innovation squared of what was used.
    pub normalized_innovation_squared: Option<f64>,
}

/// The estimate after one image: equations (11) to (18) of Li et al. 2023, each bearing gated by itself, the rest used
/// together. Bearings of other tracks are left alone. `None` if the covariance is no longer positive definite.
pub fn correct(
    estimate: DescentEstimate,
    bearings: &[BearingObservation],
    model: &CorrectionModel,
) -> Option<Corrected> {
    let mut accepted = Accepted::default();
    let mut outcomes = Outcomes::new();
    for bearing in bearings.iter().filter(|b| is_modelled(&estimate.state, b)) {
        let innovation = innovation_of(&estimate, bearing, model);
        let nis = match &innovation {
            Some(innovation) => innovation.normalized_squared(&estimate.covariance)?,
            None => f64::INFINITY,
        };
        let used = model.gate.passes(nis, 2);
        outcomes.push(Outcome {
            track_id: bearing.track_id,
            known: bearing.known.is_some(),
            normalized_innovation_squared: nis,
            used,
        });
        if let Some(innovation) = innovation.filter(|_| used) {
            // The noise of the innovation holds that of the known point from here on.
            let known = bearing.known.map(|point| KnownPoint { sigma_m: 0.0, ..point });
            accepted.bearings.push(BearingObservation { known, ..*bearing });
            accepted.innovations.push(innovation);
        }
    }
    let (mut estimate, normalized_innovation_squared) =
        if accepted.bearings.is_empty() { (estimate, None) } else { used(estimate, &accepted, model)? };
    count(&mut estimate.state, &outcomes);
    Some(Corrected { estimate, outcomes, normalized_innovation_squared })
}

/// The bearings that passed the gate, and their innovations at the prior estimate.
#[derive(Default)]
struct Accepted {
    bearings: SmallVec<[BearingObservation; 4]>,
    innovations: SmallVec<[BearingInnovation; 4]>,
}

fn is_modelled(state: &DescentState, bearing: &BearingObservation) -> bool {
    bearing.known.is_some()
        || bearing.track_id == TrackObservation::DESIGNATED
        || state.landmark_of(bearing.track_id).is_some()
}

/// The estimate after the bearings accepted: once at the prior estimate, or in Gauss–Newton steps.
fn used(
    estimate: DescentEstimate,
    accepted: &Accepted,
    model: &CorrectionModel,
) -> Option<(DescentEstimate, Option<f64>)> {
    let DescentEstimate { state, covariance } = estimate;
    let result = if model.iterations <= 1 {
        correction(covariance, &accepted.innovations)?
    } else {
        iterated_correction(&covariance, model.iterations, |error| accepted.linearized(&state, error, model))?
    };
    let estimate = DescentEstimate { state: model.kind.retract(state, &result.shift), covariance: result.covariance };
    Some((estimate, Some(result.normalized_innovation_squared)))
}

impl Accepted {
    /// The bearings linearised at a state moved by an error; one that points away there adds nothing.
    fn linearized(
        &self,
        state: &DescentState,
        error: &[f64],
        model: &CorrectionModel,
    ) -> SmallVec<[BearingInnovation; 4]> {
        let moved = model.kind.retract(state.clone(), error);
        let blank = |noise| BearingInnovation { residual: Vector2::zeros(), jacobian: SmallVec::new(), noise };
        let each = self.bearings.iter().zip(&self.innovations);
        each.map(|(bearing, first)| {
            innovation(&moved, bearing, &first.noise, model).unwrap_or_else(|| blank(first.noise))
        })
        .collect()
    }
}

/// The landmarks' counts after an image.
fn count(state: &mut DescentState, outcomes: &[Outcome]) {
    for outcome in outcomes.iter().filter(|o| !o.known) {
        if let Some(k) = state.landmark_of(outcome.track_id) {
            let landmark = &mut state.landmarks[k];
            landmark.observations += usize::from(outcome.used);
            landmark.gated = if outcome.used { 0 } else { landmark.gated + 1 };
        }
    }
}
