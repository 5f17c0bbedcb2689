//! A bearing, from pixel to correction. `measurement` makes it of a pixel and the camera's mounting, `innovation`
//! compares it with the prediction in the coordinates of the chosen filter, `correct` gates it and takes it in, all
//! bearings of a image at once. `known_sighting` is the bearing of a point whose place a map tells; `contradiction`
//! watches for a designated point that is not where the filter knows it to be.

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
