//! One drawn frame, and the record of it.

use crate::dataset::Checksums;
use crate::dataset::truth::LandmarkObservation;
use crate::render::{Detector, RenderedFrame};
use crate::scene::{SceneCamera, View};

/// An image that was drawn.
pub(super) struct DrawnFrame<'a> {
    pub key: super::request::FrameKey,
    pub camera: &'a SceneCamera,
    pub detector: &'a Detector,
    pub view: View,
    pub truth: RenderedFrame,
}

/// What is known of a finished image.
#[derive(Debug, Clone)]
pub(super) struct FrameRecord {
    /// Its files.
    pub checksums: Checksums,
    /// The landmarks within it.
    pub observations: Vec<LandmarkObservation>,
}
