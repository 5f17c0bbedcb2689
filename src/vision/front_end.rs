//! What the front end takes and gives.

use crate::dataset::{DatasetError, DesignatedPoint, Frame};
use crate::observations::{FrameStatus, RelativeRotation, TrackObservation};
use image::GrayImage;
use nalgebra::{Matrix2, Unit, UnitQuaternion, Vector2, Vector3};
use std::ops::Range;

/// Predicted rotation `camera(t_to)_from_camera(t_from)` of two times in ns; `None` where nothing is known.
pub type RotationPrediction<'a> = &'a (dyn Fn(i64, i64) -> Option<UnitQuaternion<f64>> + Sync);

/// Which images to use, and what is known besides.
#[derive(Clone)]
pub struct TrackInputs<'a> {
    /// Positions in the sequence, the end left out; clipped to the sequence.
    pub frames: Range<usize>,
    /// Take every n-th of them, 1 or more.
    pub every: usize,
    /// Predicted rotation between two times, from a gyroscope.
    pub rotation_prior: Option<RotationPrediction<'a>>,
    /// The landing point in the first image.
    pub designated: Option<DesignatedPoint>,
    /// Where to look, in all images alike: not where it is 0 (parts of the spacecraft). Features and their patches stay
    /// clear of the zeros. Of the camera's size.
    pub mask: Option<&'a GrayImage>,
}

impl Default for TrackInputs<'_> {
    fn default() -> Self {
        TrackInputs { frames: 0..usize::MAX, every: 1, rotation_prior: None, designated: None, mask: None }
    }
}

/// What was done with one image. The times are the only part of a result that may differ between two runs.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FrameReport {
    /// Position in the sequence.
    pub index: usize,
    /// Time in ns.
    pub t_ns: i64,
    /// What became of it.
    pub status: FrameStatus,
    /// What is wrong with the file and what to do, where it could not be used.
    pub problem: Option<String>,
    /// Features found.
    pub features: usize,
    /// Matches with the image before.
    pub matches: usize,
    /// Reading the file, ms.
    pub load_ms: f64,
    /// Detection, ms.
    pub detect_ms: f64,
    /// Description, ms.
    pub describe_ms: f64,
    /// Matching with the image before, and descriptors that only this needed, ms.
    pub match_ms: f64,
    /// Solving the rotation from the image before, ms.
    pub rotation_ms: f64,
}

impl FrameReport {
    /// Report of an image that could not be loaded.
    pub(super) fn unusable(frame: &Frame, error: &DatasetError) -> Self {
        let status = match error {
            DatasetError::WrongSize { .. } => FrameStatus::WrongSize,
            _ => FrameStatus::Unreadable,
        };
        let problem = Some(error.to_string());
        FrameReport { index: frame.index, t_ns: frame.t_ns, status, problem, ..FrameReport::default() }
    }
}

/// Where the designated point was carried to in one image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DesignatedStep {
    /// Time in ns.
    pub t_ns: i64,
    /// Pixel (u, v).
    pub pixel_px: Vector2<f64>,
    /// 1σ of this transfer alone, px; in the first image, of the pixel that names the point.
    pub step_sigma_px: f64,
    /// Covariance of the pixel, with the first image's and every transfer's share, px².
    pub covariance_px2: Matrix2<f64>,
    /// Size of a pixel on the ground about the point, over that in the first image.
    pub pixel_size: f64,
    /// Variance of the drift over the ground since the first image, in each coordinate, in squared pixels of that.
    pub drift_first_px2: f64,
    /// Time of the image that it was carried from, ns.
    pub t_ns_from: i64,
    /// Whether the grey levels about the point refined what the matches said.
    pub refined: bool,
}

/// Everything that the front end found in a sequence.
#[derive(Debug, Clone, PartialEq)]
pub struct FrontEnd {
    /// Tracks of two or more images in order of time, then of track number; the designated point's σ is that of its
    /// last step: of the pixel given the ground point that is tracked. Its drift off the site is in `designated`.
    pub observations: Vec<TrackObservation>,
    /// Rotations of adjacent images in order of time; then, in order of time too, those of images on both sides of
    /// images that cannot be used, and of keyframe pairs.
    pub rotations: Vec<RelativeRotation>,
    /// One report an image, those that could not be used included.
    pub frames: Vec<FrameReport>,
    /// Direction of the centre of rotation, in the fixed-centre mode.
    pub center_in_camera: Option<Unit<Vector3<f64>>>,
    /// Covariance (rad²) of that direction along the axes of [`crate::geometry::so3::tangent_basis`].
    pub center_covariance_rad2: Option<Matrix2<f64>>,
    /// The designated point, as long as it could be carried.
    pub designated: Vec<DesignatedStep>,
    /// Wall time in ms of each stage over the whole sequence, in order.
    pub stage_ms: Vec<(&'static str, f64)>,
}

impl DesignatedStep {
    /// As an observation of track [`TrackObservation::DESIGNATED`].
    pub fn observation(&self) -> TrackObservation {
        TrackObservation {
            t_ns: self.t_ns,
            track_id: TrackObservation::DESIGNATED,
            pixel_px: self.pixel_px,
            sigma_px: self.step_sigma_px,
            response: 0.0,
        }
    }
}
