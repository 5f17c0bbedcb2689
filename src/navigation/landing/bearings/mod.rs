//! Bearings of known and unknown landmarks: what one measures, its innovation, the correction, and contradictions.

mod contradiction;
mod correct;
mod innovation;
mod known_sighting;
mod measurement;

pub use contradiction::Contradiction;
pub use correct::{Corrected, Outcome, Outcomes, correct};
pub use innovation::{BearingInnovation, CorrectionModel, innovation};
pub use known_sighting::KnownSighting;
pub use measurement::{BearingObservation, CameraMount, KnownPoint};
