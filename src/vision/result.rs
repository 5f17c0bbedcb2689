//! Plain results of the front end, free of OpenCV, for the rooms that come after.

use nalgebra::{Matrix3, UnitQuaternion, Vector2};
use serde::{Deserialize, Serialize};

/// Where one track was seen in one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrackObservation {
    /// Time of the frame in ns.
    pub t_ns: i64,
    /// The track's number; the same number is the same surface point. The designated point is [`Self::DESIGNATED`].
    pub track_id: u64,
    /// Pixel (u, v).
    pub pixel_px: Vector2<f64>,
    /// 1σ of each coordinate in px.
    pub sigma_px: f64,
    /// Harris response, 0 where there is none (the designated point).
    pub response: f64,
}

impl TrackObservation {
    /// Track number of the designated landing point.
    pub const DESIGNATED: u64 = 0;
}

/// Pixels of the same surface points in two frames.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MatchedPair {
    /// Pixels in the first frame.
    pub from_px: Vec<Vector2<f64>>,
    /// Pixels in the second frame, in the same order.
    pub to_px: Vec<Vector2<f64>>,
}

/// The geometric model that gave a rotation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RotationModel {
    /// Essential matrix.
    Essential,
    /// Homography of a plane, or of a pure rotation.
    Homography,
    /// The body turns about a fixed centre (3 degrees of freedom).
    FixedCenter,
    /// No model fits.
    None,
}

/// What became of an image pair.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PairStatus {
    /// The rotation can be used.
    Ok,
    /// A frame without features.
    NoFeatures,
    /// Too few matches.
    FewMatches,
    /// The geometry does not determine a rotation.
    Degenerate,
    /// Nothing moved.
    NoMotion,
    /// The result contradicts its neighbours or itself.
    Rejected,
}

/// What became of one frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FrameStatus {
    /// Its features were used.
    #[default]
    Ok,
    /// Too few features for a pair: dark, saturated, or without texture.
    NoFeatures,
    /// Its size is not the camera's.
    WrongSize,
    /// The file is missing or damaged.
    Unreadable,
}

impl FrameStatus {
    /// The outcome's word in files.
    pub fn word(self) -> &'static str {
        match self {
            FrameStatus::Ok => "ok",
            FrameStatus::NoFeatures => "no-features",
            FrameStatus::WrongSize => "wrong-size",
            FrameStatus::Unreadable => "unreadable",
        }
    }
}

/// Rotation between two frames.
#[derive(Debug, Clone, PartialEq)]
pub struct RelativeRotation {
    /// Time of the first frame in ns.
    pub t_ns_from: i64,
    /// Time of the second frame in ns.
    pub t_ns_to: i64,
    /// The rotation camera(t_to)_from_camera(t_from); identity where the status is not ok.
    pub camera_to_from_camera_from: UnitQuaternion<f64>,
    /// Covariance (rad²) of the error `d` in `true = exp(d) * estimated`, in axes of the second camera.
    pub covariance_rad2: Matrix3<f64>,
    /// Matches that went in.
    pub matches: usize,
    /// Matches that agree.
    pub inliers: usize,
    /// The model used.
    pub model: RotationModel,
    /// The outcome.
    pub status: PairStatus,
}
