//! The rotation between two images, and what became of the pair.

use nalgebra::{Matrix3, UnitQuaternion};
use serde::{Deserialize, Serialize};

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
