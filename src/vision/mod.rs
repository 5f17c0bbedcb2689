//! The image front end: the only room that names OpenCV.

mod result;

pub use result::{MatchedPair, PairStatus, RelativeRotation, RotationModel, TrackObservation};
