//! Vision-aided inertial navigation of a lander: one known landmark (the designated landing point, the origin of the
//! `site` frame) and a few unknown ones, each chosen for what its observation will tell.
//!
//! [`navigate`] runs a whole descent; [`step`] is one frame of it and reads as the paper reads (Li et al. 2023). The
//! filter comes in two forms that differ only in the coordinates of the error: [`FilterKind::Hybrid`], which stays
//! consistent because nothing in it can pretend to observe yaw, and [`FilterKind::Standard`], the paper's own.

mod bearings;
mod config;
mod error;
mod error_state;
mod files;
mod inertial;
mod input;
mod landmarks;
mod map_aiding;
mod navigate;
mod propagation;
mod result;
mod step;

pub use bearings::{
    BearingInnovation, BearingObservation, CameraMount, Contradiction, Corrected, CorrectionModel, KnownPoint,
    KnownSighting, Outcome, Outcomes,
};
pub use bearings::{correct, innovation};
pub use config::{BiasPrior, ImageRotationUse, LandingConfig, LandmarkStart};
pub use error::LandingError;
pub use error_state::{
    Core, DescentEstimate, DescentState, FilterKind, LandmarkRole, LandmarkTransition, RayPoint, RelativeJacobian,
    Transition, UnknownLandmark,
};
pub use files::{write_covariance_csv, write_estimate_csv};
pub use inertial::{
    GAP_FORCE_SIGMA_M_S2, GAP_RATE_SIGMA_RAD_S, ImuBiases, ImuIncrement, ImuRecord, LONGEST_GAP_S, Planet,
};
pub use input::LandingInput;
pub use landmarks::{
    InitializationModel, LookAhead, Memory, initial_estimate, survives, triangulated, viewpoint, with_landmark,
    with_landmark_at_height, with_ray, without_landmark,
};
pub use map_aiding::{PointByMap, SightedByMap, sighted_by_map};
pub use navigate::navigate;
pub use propagation::predict;
pub use propagation::{ImageRotation, RotationCheck, image_rotations};
pub use result::{ImuGap, LandingEpoch, LandingResult};
pub use step::{FrameInput, Navigator, StepReport, step};
