//! Correction by the bearings of one image.

use super::innovation::{BearingInnovation, CorrectionModel, innovation, innovation_of};
use super::measurement::{BearingObservation, KnownPoint};
use crate::navigation::filter::{Innovation, iterated_correction};
use crate::navigation::landing::error_state::{DescentEstimate, DescentState, FilterKind, LARGEST};
use crate::observations::TrackObservation;
use nalgebra::{DMatrix, DVector, Matrix2, Matrix2x3, Vector2};
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
    let mut pairs = [Vector2::zeros(); LARGEST];
    let mut accepted: SmallVec<[(BearingObservation, BearingInnovation); 4]> = SmallVec::new();
    let mut outcomes = Outcomes::new();
    for bearing in bearings.iter().filter(|b| is_modelled(&estimate.state, b)) {
        let innovation = innovation_of(&estimate, bearing, model);
        let nis = match &innovation {
            Some(innovation) => {
                innovation.times_covariance(&estimate.covariance, &mut pairs);
                let inverse = positive_inverse(&innovation.covariance(&pairs))?;
                innovation.residual.dot(&(inverse * innovation.residual))
            }
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
            accepted.push((BearingObservation { known, ..*bearing }, innovation));
        }
    }
    let (mut estimate, normalized_innovation_squared) = match (accepted.is_empty(), model.iterations) {
        (true, _) => (estimate, None),
        (false, 0 | 1) => once(estimate, &accepted, &mut pairs, model.kind)?,
        _ => repeatedly(estimate, &accepted, model)?,
    };
    count(&mut estimate.state, &outcomes);
    Some(Corrected { estimate, outcomes, normalized_innovation_squared })
}

fn is_modelled(state: &DescentState, bearing: &BearingObservation) -> bool {
    bearing.known.is_some()
        || bearing.track_id == TrackObservation::DESIGNATED
        || state.landmark_of(bearing.track_id).is_some()
}

/// One bearing after the other, in Joseph's form, all linearised at the prior estimate: the same as all at once.
fn once(
    estimate: DescentEstimate,
    accepted: &[(BearingObservation, BearingInnovation)],
    pairs: &mut [Vector2<f64>; LARGEST],
    kind: FilterKind,
) -> Option<(DescentEstimate, Option<f64>)> {
    let DescentEstimate { state, mut covariance } = estimate;
    let n = covariance.nrows();
    let mut shift = [0.0; LARGEST];
    let mut total = 0.0;
    for (_, innovation) in accepted {
        innovation.times_covariance(&covariance, pairs);
        let inverse = positive_inverse(&innovation.covariance(pairs))?;
        let residual = innovation.residual - innovation.times(&shift[..n]);
        let weighted = inverse * residual;
        total += residual.dot(&weighted);
        for (component, pair) in shift.iter_mut().zip(&pairs[..n]) {
            *component += pair.dot(&weighted);
        }
        joseph(&mut covariance, innovation, &pairs[..n], &inverse);
    }
    Some((DescentEstimate { state: kind.retract(state, &shift[..n]), covariance }, Some(total)))
}

/// P ← (I - K H) P (I - K H)ᵀ + K R Kᵀ with K = P Hᵀ S⁻¹, in place; `pairs` holds H P.
fn joseph(p: &mut DMatrix<f64>, innovation: &BearingInnovation, pairs: &[Vector2<f64>], inverse: &Matrix2<f64>) {
    let n = pairs.len();
    let mut gains = [Vector2::zeros(); LARGEST];
    for (gain, pair) in gains.iter_mut().zip(pairs) {
        *gain = inverse * pair;
    }
    let gains = &gains[..n];
    // (I - K H) P, column by column.
    for (mut column, pair) in p.column_iter_mut().zip(pairs) {
        for (entry, gain) in column.as_mut_slice().iter_mut().zip(gains) {
            *entry -= gain.dot(pair);
        }
    }
    // What is left of H P after that, row by row: W = ((I - K H) P) Hᵀ - K R.
    let mut left = [Vector2::zeros(); LARGEST];
    for (start, block) in innovation.blocks() {
        for k in 0..3 {
            let weight = block.column(k).into_owned();
            for (pair, entry) in left.iter_mut().zip(p.column(start + k).as_slice()) {
                *pair += weight * *entry;
            }
        }
    }
    for (pair, gain) in left.iter_mut().zip(gains) {
        *pair -= innovation.noise * gain;
    }
    for (mut column, gain) in p.column_iter_mut().zip(gains) {
        for (entry, pair) in column.as_mut_slice().iter_mut().zip(&left[..n]) {
            *entry -= pair.dot(gain);
        }
    }
    make_symmetric(p);
}

fn make_symmetric(p: &mut DMatrix<f64>) {
    for column in 0..p.ncols() {
        for row in column + 1..p.nrows() {
            let mean = 0.5 * (p[(row, column)] + p[(column, row)]);
            p[(row, column)] = mean;
            p[(column, row)] = mean;
        }
    }
}

fn positive_inverse(s: &Matrix2<f64>) -> Option<Matrix2<f64>> {
    let determinant = s.determinant();
    (s[(0, 0)] > 0.0 && determinant > 0.0)
        .then(|| Matrix2::new(s[(1, 1)], -s[(0, 1)], -s[(1, 0)], s[(0, 0)]) / determinant)
}

/// Gauss–Newton on the posterior, every bearing linearised anew at each step.
fn repeatedly(
    estimate: DescentEstimate,
    accepted: &[(BearingObservation, BearingInnovation)],
    model: &CorrectionModel,
) -> Option<(DescentEstimate, Option<f64>)> {
    let n = estimate.covariance.nrows();
    let linearize = |error: &DVector<f64>| {
        let state = model.kind.retract(estimate.state.clone(), error.as_slice());
        // A bearing that points away at this step adds nothing to it.
        let blank = |b: &BearingInnovation| BearingInnovation {
            residual: Vector2::zeros(),
            by_position: Matrix2x3::zeros(),
            by_attitude: Matrix2x3::zeros(),
            by_landmark: None,
            noise: b.noise,
        };
        let parts: Vec<Innovation> = accepted
            .iter()
            .map(|(bearing, first)| {
                innovation(&state, bearing, &first.noise, model).unwrap_or_else(|| blank(first)).dense(n)
            })
            .collect();
        Innovation::stacked(&parts).expect("at least one bearing is accepted")
    };
    let correction = iterated_correction(&estimate.covariance, model.iterations, linearize)?;
    let state = model.kind.retract(estimate.state, correction.shift.as_slice());
    let estimate = DescentEstimate { state, covariance: correction.covariance };
    Some((estimate, Some(correction.normalized_innovation_squared)))
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
