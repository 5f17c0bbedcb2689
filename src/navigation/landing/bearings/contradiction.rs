//! What to do when the filter and the known landmark contradict each other: which of the two is wrong.
//!
//! A filter that was wrong from the start has never agreed with the point, and one whose motion was measured wrong
//! contradicts the other landmarks too. Then the filter gives itself less credit, until the point is an ordinary sight
//! again. A point that has agreed, and from one image to the next lies far off while no other landmark says that the
//! filter is wrong, has jumped to something else: it is left out for as long as that lasts, and the flight goes on by the
//! others and the IMU. Errors that grow little by little never look so, since they meet the gate while they are small.

use super::correct::Outcome;
use crate::navigation::landing::error_state::{ATTITUDE, BIASES, DescentEstimate, FilterKind};
use crate::observations::TrackObservation;

/// Contradictions in a row after which a filter that may be wrong is taken to be.
const CONTRADICTING_IMAGES: usize = 3;
/// Largest factor by which a covariance is inflated at once.
const LARGEST_INFLATION: f64 = 100.0;
/// Sights of the point that must have agreed before it can be said to have jumped.
const AGREEING_IMAGES: usize = 3;
/// Normalised innovation squared beyond which a sight after agreeing ones is a jump, 10σ: a smaller one costs little if
/// it is believed, and may be the filter's own.
const JUMP_NORMALIZED_SQUARED: f64 = 100.0;
/// Images in a row whose other landmarks are all gated too, after which the filter is no longer thought right: then they
/// are replaced by new ones, which say nothing of what was before.
const UNSUPPORTED: usize = 2;

/// How often in a row, and how badly, the known landmark was gated.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Contradiction {
    /// Images in a row.
    pub images: usize,
    /// Normalised innovation squared of the last one.
    pub normalized_innovation_squared: f64,
    /// Sights that agreed since the start, or since the covariance was last inflated.
    pub agreements: usize,
    /// Whether the point, not the filter, is taken to be wrong.
    pub point_is_wrong: bool,
    /// Images in a row in which no other landmark agreed with the filter either.
    pub unsupported: usize,
}

impl Contradiction {
    /// The count after an image.
    pub fn after(self, outcomes: &[Outcome]) -> Self {
        let agreements = if self.filter_is_wrong() { 0 } else { self.agreements };
        match outcomes.iter().find(|o| is_point(o)) {
            Some(o) if !o.used => Contradiction { agreements, ..self }.contradicted(o, outcomes),
            Some(_) => Contradiction { agreements: agreements + 1, ..Contradiction::default() },
            None => Contradiction { agreements, ..self },
        }
    }

    fn contradicted(self, point: &Outcome, outcomes: &[Outcome]) -> Self {
        let others = || outcomes.iter().filter(|o| !is_point(o));
        let agreeing = others().filter(|o| o.used).count();
        let unsupported = if agreeing == 0 && others().count() > 0 { self.unsupported + 1 } else { 0 };
        let has_jumped = self.agreements >= AGREEING_IMAGES
            && point.normalized_innovation_squared > JUMP_NORMALIZED_SQUARED
            && 2 * agreeing >= others().count();
        let point_is_wrong = if self.images == 0 { has_jumped } else { self.point_is_wrong };
        Contradiction {
            images: self.images + 1,
            normalized_innovation_squared: point.normalized_innovation_squared,
            point_is_wrong: point_is_wrong && unsupported < UNSUPPORTED,
            unsupported,
            ..self
        }
    }

    /// Whether the filter has been contradicted for long enough, by a point that may well be right.
    pub fn filter_is_wrong(&self) -> bool {
        self.images >= CONTRADICTING_IMAGES && !self.point_is_wrong
    }

    /// The estimate, of a filter that is wrong with its covariance inflated so far that the last contradiction would be
    /// an ordinary innovation. What images can never restore is left alone: yaw, or in the standard coordinates, which
    /// do not separate it, the whole attitude.
    pub fn resolved(self, mut estimate: DescentEstimate, kind: FilterKind) -> DescentEstimate {
        if !self.filter_is_wrong() {
            return estimate;
        }
        let factor = (0.5 * self.normalized_innovation_squared).clamp(1.0, LARGEST_INFLATION).sqrt();
        let kept = if kind == FilterKind::Hybrid { ATTITUDE + 2..BIASES } else { ATTITUDE..BIASES };
        for k in (0..estimate.covariance.nrows()).filter(|k| !kept.contains(k)) {
            estimate.covariance.row_mut(k).scale_mut(factor);
            estimate.covariance.column_mut(k).scale_mut(factor);
        }
        estimate
    }
}

fn is_point(outcome: &Outcome) -> bool {
    outcome.track_id == TrackObservation::DESIGNATED && !outcome.known
}
