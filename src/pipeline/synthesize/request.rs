//! What is asked of a synthesis, and what comes of it.

use crate::settings::Layers;
use std::ops::Range;
use std::path::PathBuf;
use std::time::Duration;

/// Where the time of drawing and writing went.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DrawTiming {
    /// Images drawn.
    pub drawn: usize,
    /// From the first image's beginning to the last one's file.
    pub wall: Duration,
    /// Time in the renderer.
    pub drawing: Duration,
    /// Time in the threads that expose, pack and write, all together; it runs beside the drawing.
    pub finishing: Duration,
}

/// What to render, and where to.
#[derive(Debug, Clone)]
pub struct SynthesizeRequest {
    /// The scenario file.
    pub scenario: PathBuf,
    /// The data set's folder.
    pub out: PathBuf,
    /// What is laid over the scenario.
    pub layers: Layers,
    /// Frames of each camera to make beside those that are there already; all if `None`.
    pub frames: Option<Range<usize>>,
    /// Continue an interrupted job.
    pub resume: bool,
    /// Part of the name of the graphics adapter to use.
    pub adapter: Option<String>,
}

/// What was made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Synthesized {
    /// Frames of each camera in the data set.
    pub frames: usize,
    /// Cameras in the data set.
    pub cameras: usize,
    /// Where the time went.
    pub timing: DrawTiming,
}

/// An image of a data set: its camera's place in [`Scene::cameras`] and its own place in the camera's views.
pub(super) type FrameKey = (usize, usize);
