//! What to do when the filter and the known landmark contradict each other for long.

use super::DescentEstimate;
use super::correct::Outcome;
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
        match outcomes.iter().find(|o| o.track_id == TrackObservation::DESIGNATED) {
            Some(o) if !o.used => Contradiction {
                images: self.images + 1,
                normalized_innovation_squared: o.normalized_innovation_squared,
            },
            Some(_) => Contradiction::default(),
            None => self,
        }
    }

    /// The estimate, after three contradictions in a row with its covariance inflated so far that the last one would be
    /// an ordinary innovation.
    pub fn resolved(self, mut estimate: DescentEstimate) -> DescentEstimate {
        if self.images >= PATIENCE {
            estimate.covariance *= (0.5 * self.normalized_innovation_squared).clamp(1.0, LARGEST_INFLATION);
        }
        estimate
    }
}
