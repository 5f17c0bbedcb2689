//! Bearings of known and unknown landmarks: what one measures, its innovation, the correction, and contradictions.

mod contradiction;
mod correct;
mod innovation;
mod measurement;

pub use contradiction::Contradiction;
pub use correct::{Corrected, CorrectionModel, Outcome, Outcomes, correct};
pub use innovation::{BearingInnovation, innovation};
pub use measurement::{BearingObservation, CameraMount, KnownPoint, ground_point};
