//! What to do when the filter and the known landmark contradict each other for long.

use super::correct::Outcome;
use super::state::{ATTITUDE, BIASES};
use super::{DescentEstimate, FilterKind};
use crate::vision::TrackObservation;

/// Contradictions in a row after which the filter, not the measurement, is taken to be wrong.
const PATIENCE: usize = 3;
/// Largest factor by which a covariance is inflated at once.
const LARGEST_INFLATION: f64 = 100.0;

/// How often in a row, and how badly, the known landmark was gated.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Contradiction {
    /// Images in a row.
    pub images: usize,
    /// Normalised innovation squared of the last one.
    pub normalized_innovation_squared: f64,
}

impl Contradiction {
    /// The count after an image.
    pub fn after(self, outcomes: &[Outcome]) -> Self {
        match outcomes.iter().find(|o| o.track_id == TrackObservation::DESIGNATED && !o.known) {
            Some(o) if !o.used => Contradiction {
                images: self.images + 1,
                normalized_innovation_squared: o.normalized_innovation_squared,
            },
            Some(_) => Contradiction::default(),
            None => self,
        }
    }

    /// The estimate, after three contradictions in a row with its covariance inflated so far that the last one would be
    /// an ordinary innovation. What images can never restore is left alone: yaw, or in the standard coordinates, which
    /// do not separate it, the whole attitude.
    pub fn resolved(self, mut estimate: DescentEstimate, kind: FilterKind) -> DescentEstimate {
        if self.images < PATIENCE {
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
