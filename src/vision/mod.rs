//! The image front end: the only room that names OpenCV.
//!
//! Corners (Harris', or those of another [`Detector`]) are found in every image, located to a fraction of a pixel,
//! described by ORB (or another [`Descriptor`]) and matched from image to image, all of it by OpenCV. Each pair's matches
//! are explained by the model that fits the scene, which gives the rotation between the images with its covariance, and
//! verified matches chain into tracks. What comes of it, and its files, are [`observations`](crate::observations), which
//! are free of OpenCV.
//!
//! # From a folder of images to rotations
//!
#![cfg_attr(feature = "vision", doc = "```")]
#![cfg_attr(not(feature = "vision"), doc = "```ignore")]
//! use opnav::dataset::{CameraSource, ImageSequence};
//! use opnav::observations::*;
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
//!     println!("image {} was not used: {}", frame.index, frame.status.word());
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

mod config;
mod designated;
mod error;
mod features;
mod front_end;
mod implementation;
mod map;
mod masks;
mod matching;
mod noise_model;
mod opencv_bridge;
mod pair;
mod patch;
mod registry;
mod sequence;
mod tracking;

pub use config::{FrontEndConfig, FrontEndMode};
pub use designated::drift_per_image_px;
pub use error::VisionError;
pub use features::{
    Detector, DetectorConfig, DetectorKind, Feature, FusedResponse, PeakModel, ResponseConfig, Responses,
    detect_features, noise_sigma_dn,
};
pub use front_end::{DesignatedStep, FrameReport, FrontEnd, RotationPrediction, TrackInputs};
pub use implementation::Implementation;
pub use map::{MapFeatures, MapFix, MapMatchConfig, MapMatcher, MapSighting, MapStatus};
pub use masks::{bright_centroid_px, inside_silhouette};
pub use matching::{
    Described, Descriptor, DescriptorConfig, DescriptorKind, DescriptorNorm, DescriptorSet, IndexMatch, MatchLimits,
    MatcherConfig, Orientation, Predict, SiftConfig, describe_features, match_features, match_features_guided,
};
pub use noise_model::{
    BodyNoise, Constant, CornerNoise, DesignatedNoise, MapNoise, NoiseModel, NoiseModelFile, PairNoise, PatchNoise,
};
pub use opencv_bridge::opencv_version;
pub use pair::relative_rotation;
pub use pair::{
    CenterProblem, CenterSolution, CenteredPair, FixedCenterConfig, MatchedPair, PairHints, PairSolution, PixelMatches,
    RotationConfig, rotations_about_center,
};
pub use patch::{KltConfig, KltPoint, track_patches};
pub use sequence::track_sequence;
