//! The image front end: the only room that names OpenCV.
//!
//! Harris corners are found in every picture, located to a fraction of a pixel, described by ORB (or SIFT) and matched
//! from picture to picture. Each pair's matches are explained by the model that fits the scene, which gives the rotation between the
//! pictures with its covariance, and verified matches chain into tracks. Plain results ([`TrackObservation`],
//! [`RelativeRotation`]) and their files are free of OpenCV and are compiled without the `vision` feature too.
//!
//! # From a folder of pictures to rotations
//!
#![cfg_attr(feature = "vision", doc = "```")]
#![cfg_attr(not(feature = "vision"), doc = "```ignore")]
//! use opnav::dataset::{CameraSource, ImageSequence};
//! use opnav::vision::*;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let made = tempfile::tempdir()?;
//! # let folder = made.path();
//! # let speck = |x: u32, y: u32| (x.wrapping_mul(0x9e37_79b1) ^ y.wrapping_mul(0x85eb_ca77)).wrapping_mul(0xc2b2_ae3d) >> 24;
//! # let ground = image::GrayImage::from_fn(320, 320, |x, y| image::Luma([speck(x / 3, y / 3) as u8]));
//! # let ground = image::imageops::blur(&ground, 1.5);
//! # for k in 0..3 {
//! #     use imageproc::geometric_transformations::{Border, Interpolation, rotate_about_center};
//! #     let turn_rad = (2.0 * k as f32).to_radians();
//! #     let turned = rotate_about_center(&ground, turn_rad, Interpolation::Bilinear, Border::Constant(image::Luma([0])));
//! #     image::imageops::crop_imm(&turned, 60, 60, 200, 200).to_image().save(folder.join(format!("{k}.png")))?;
//! # }
//! let camera = CameraSource::HorizontalFov(60f64.to_radians());
//! let sequence = ImageSequence::open(folder, &camera)?;
//! let found = track_sequence(&sequence, &FrontEndConfig::default(), &TrackInputs::default(), &|_| ())?;
//!
//! for frame in found.frames.iter().filter(|frame| frame.status != FrameStatus::Ok) {
//!     println!("picture {} was not used: {}", frame.index, frame.status.word());
//! }
//! for pair in &found.rotations {
//!     let turn_deg = pair.camera_to_from_camera_from.angle().to_degrees();
//!     let sigma_deg = pair.covariance_rad2.trace().sqrt().to_degrees();
//!     let (from, to, status) = (pair.t_ns_from, pair.t_ns_to, pair.status.word());
//!     println!("{from} to {to} ns: {turn_deg:.3} ± {sigma_deg:.3} degrees, {} matches, {status}", pair.inliers);
//! }
//! let times_ns: Vec<i64> = found.frames.iter().map(|frame| frame.t_ns).collect();
//! for chain in attitude_chains(&times_ns, &found.rotations) {
//!     println!("an unbroken chain of {} attitudes from {} ns on", chain.len(), chain[0].t_ns);
//! }
//! write_relative_rotations(&folder.join("relative_rotations.csv"), &found.rotations)?;
//! # let first = &found.rotations[0];
//! # assert_eq!((first.status, found.rotations.len()), (PairStatus::Ok, 3));
//! # assert!((first.camera_to_from_camera_from.angle().to_degrees() - 2.0).abs() < 0.05);
//! # Ok(())
//! # }
//! ```

#[cfg(feature = "vision")]
mod adjacent_pair;
mod attitude_chain;
#[cfg(feature = "vision")]
mod candidates;
#[cfg(feature = "vision")]
mod center_start;
#[cfg(feature = "vision")]
mod chain;
#[cfg(feature = "vision")]
mod cheirality;
#[cfg(feature = "vision")]
mod clusters;
#[cfg(feature = "vision")]
mod config;
#[cfg(feature = "vision")]
mod corner_peak;
#[cfg(feature = "vision")]
mod descriptions;
#[cfg(feature = "vision")]
mod descriptor;
#[cfg(feature = "vision")]
mod designated;
#[cfg(feature = "vision")]
mod designated_keyframes;
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
mod ground_fit;
#[cfg(feature = "vision")]
mod ground_model;
#[cfg(feature = "vision")]
mod ground_start;
#[cfg(feature = "vision")]
mod harris;
#[cfg(feature = "vision")]
mod harris_response;
#[cfg(feature = "vision")]
mod keep_out;
#[cfg(feature = "vision")]
mod keyframes;
#[cfg(feature = "vision")]
mod klt;
#[cfg(feature = "vision")]
mod line_filter;
#[cfg(feature = "vision")]
mod local_affine;
#[cfg(feature = "vision")]
mod local_maxima;
#[cfg(feature = "vision")]
mod lost_tracks;
#[cfg(feature = "vision")]
mod map;
#[cfg(feature = "vision")]
mod matcher_config;
#[cfg(feature = "vision")]
mod matching;
#[cfg(feature = "vision")]
mod motion;
#[cfg(feature = "vision")]
mod opencv_bridge;
#[cfg(feature = "vision")]
mod orb;
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
mod patch_stretch;
#[cfg(feature = "vision")]
mod picture_noise;
#[cfg(feature = "vision")]
mod plausible;
#[cfg(feature = "vision")]
mod pure_turn;
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
mod sift;
#[cfg(feature = "vision")]
mod sight;
#[cfg(feature = "vision")]
mod silhouette;
#[cfg(feature = "vision")]
mod smooth_error;
#[cfg(feature = "vision")]
mod smooth_modes;
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
    config::{DetectorConfig, FixedCenterConfig, FrontEndConfig, FrontEndMode, KltConfig, RotationConfig},
    descriptor::{Descriptor, MatchLimits, Orientation},
    error::VisionError,
    fixed_center::{CenterProblem, CenterSolution, CenteredPair, rotations_about_center},
    front_end::{DesignatedStep, FrameReport, FrontEnd, RotationPrediction, TrackInputs},
    harris::{Feature, detect_harris},
    klt::{KltPoint, track_patches},
    map::{MapFix, MapMatchConfig, MapMatcher, MapSighting, MapStatus, PredictedCamera},
    matcher_config::{DescriptorKind, MatcherConfig, SiftConfig},
    matching::{Described, IndexMatch, match_features, match_features_guided},
    orb::{OrbDescriptor, describe_orb},
    picture_noise::noise_sigma_dn,
    relative_rotation::{PairHints, PairSolution, PixelMatches, relative_rotation},
    sequence::track_sequence,
    sift::{SiftDescriptor, describe_sift},
    silhouette::{bright_centroid_px, inside_silhouette},
};
