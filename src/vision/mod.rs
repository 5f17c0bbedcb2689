//! The image front end: the only room that names OpenCV.
//!
//! Harris corners are found in every picture, located to a fraction of a pixel, described by ORB and matched from picture
//! to picture. Each pair's matches are explained by the model that fits the scene, which gives the rotation between the
//! pictures with its covariance, and verified matches chain into tracks. Plain results ([`TrackObservation`],
//! [`RelativeRotation`]) and their files are free of OpenCV and are compiled without the `vision` feature too.

#[cfg(feature = "vision")]
mod adjacent_pair;
mod attitude_chain;
#[cfg(feature = "vision")]
mod candidates;
#[cfg(feature = "vision")]
mod center_start;
#[cfg(feature = "vision")]
mod config;
#[cfg(feature = "vision")]
mod descriptor;
#[cfg(feature = "vision")]
mod designated;
#[cfg(feature = "vision")]
mod error;
#[cfg(feature = "vision")]
mod evenly;
#[cfg(feature = "vision")]
mod fixed_center;
#[cfg(feature = "vision")]
mod frame_features;
#[cfg(feature = "vision")]
mod front_end;
#[cfg(feature = "vision")]
mod harris;
#[cfg(feature = "vision")]
mod keyframes;
#[cfg(feature = "vision")]
mod local_affine;
#[cfg(feature = "vision")]
mod matching;
#[cfg(feature = "vision")]
mod opencv_bridge;
mod overlay;
#[cfg(feature = "vision")]
mod pair_fit;
#[cfg(feature = "vision")]
mod pair_models;
#[cfg(feature = "vision")]
mod pair_order;
#[cfg(feature = "vision")]
mod patch;
#[cfg(feature = "vision")]
mod plausible;
#[cfg(feature = "vision")]
mod relative_rotation;
mod result;
#[cfg(feature = "vision")]
mod rivals;
mod rotations_file;
#[cfg(feature = "vision")]
mod sequence;
#[cfg(feature = "vision")]
mod sharpen;
#[cfg(feature = "vision")]
mod sight;
#[cfg(feature = "vision")]
mod silhouette;
mod text_table;
#[cfg(feature = "vision")]
mod tracks;
mod tracks_file;
#[cfg(feature = "vision")]
mod usac;

pub use attitude_chain::attitude_chains;
#[cfg(feature = "vision")]
pub use opencv_bridge::opencv_version;
pub use overlay::{contact_sheet, draw_tracks};
pub use result::{FrameStatus, MatchedPair, PairStatus, RelativeRotation, RotationModel, TrackObservation};
pub use rotations_file::{read_relative_rotations, write_relative_rotations};
pub use tracks_file::{read_tracks, write_tracks};

#[cfg(feature = "vision")]
pub use {
    config::{DetectorConfig, FixedCenterConfig, FrontEndConfig, FrontEndMode, MatcherConfig, RotationConfig},
    descriptor::{Descriptor, Orientation, describe},
    error::VisionError,
    fixed_center::{CenterProblem, CenterSolution, CenteredPair, rotations_about_center},
    front_end::{DesignatedStep, FrameReport, FrontEnd, RotationPrediction, TrackInputs},
    harris::{Feature, detect_harris, noise_sigma_dn},
    matching::{Described, IndexMatch, match_features, match_features_guided},
    relative_rotation::{PairHints, PairSolution, PixelMatches, relative_rotation},
    sequence::track_sequence,
    silhouette::{bright_centroid_px, inside_silhouette},
};
