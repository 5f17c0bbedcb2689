//! Correction by the bearings of one image.

use super::coordinates::RelativeJacobian;
use super::measurement::{BearingObservation, KnownPoint};
use super::state::{ATTITUDE, LARGEST, POSITION};
use super::{DescentEstimate, DescentState, FilterKind};
use crate::geometry::so3::tangent_basis;
use crate::navigation::filter::{Gate, Innovation, iterated_correction};
use crate::navigation::landmark::projector_over_range;
use crate::vision::TrackObservation;
use nalgebra::{DMatrix, DVector, Matrix2, Matrix2x3, Matrix3, Vector2, Vector3};
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

    fn blocks(&self) -> impl Iterator<Item = (usize, &Matrix2x3<f64>)> {
        let landmark = self.by_landmark.as_ref().map(|(start, block)| (*start, block));
        [(POSITION, &self.by_position), (ATTITUDE, &self.by_attitude)].into_iter().chain(landmark)
    }

    /// H x for a column x of the error state.
    fn times(&self, column: &[f64]) -> Vector2<f64> {
        self.blocks().map(|(start, block)| block * Vector3::from_column_slice(&column[start..start + 3])).sum()
    }

    /// (P Hᵀ)ᵀ = H P, a pair a column of P.
    fn times_covariance(&self, p: &DMatrix<f64>, pairs: &mut [Vector2<f64>; LARGEST]) {
        for (pair, column) in pairs.iter_mut().zip(p.column_iter()) {
            *pair = self.times(column.as_slice());
        }
    }

    /// H P Hᵀ + R.
    fn covariance(&self, pairs: &[Vector2<f64>; LARGEST]) -> Matrix2<f64> {
        let mut s = self.noise;
        for (start, block) in self.blocks() {
            s += Matrix2x3::from_columns(&[pairs[start], pairs[start + 1], pairs[start + 2]]) * block.transpose();
        }
        (s + s.transpose()) * 0.5
    }
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
        let innovation = gated_innovation(&estimate, bearing, model);
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
fn gated_innovation(
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
