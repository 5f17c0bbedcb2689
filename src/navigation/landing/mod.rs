//! Vision-aided inertial navigation of a lander: one known landmark (the designated landing point, the origin of the
//! `site` frame) and a few unknown ones, each chosen for what its observation will tell.
//!
//! [`navigate`] runs a whole descent; [`step`] is one frame of it and reads as the paper reads (Li et al. 2023). The
//! filter comes in two forms that differ only in the coordinates of the error: [`FilterKind::Hybrid`], which stays
//! consistent because nothing in it can pretend to observe yaw, and [`FilterKind::Standard`], the paper's own.

mod bearing_innovation;
mod candidates;
mod config;
mod coordinates;
mod correct;
mod covariance;
mod delayed;
mod designated;
mod error;
mod files;
mod hybrid;
mod imu;
mod initialize;
mod input;
mod measurement;
mod navigate;
mod planet;
mod predict;
mod recovery;
mod result;
mod rotation;
mod select;
mod standard;
mod state;
mod step;

pub use bearing_innovation::{BearingInnovation, innovation};
pub use candidates::{LookAhead, survives, viewpoint};
pub use config::{BiasPrior, FilterKind, LandingConfig, LandmarkStart};
pub use coordinates::{LandmarkTransition, RayPoint, RelativeJacobian, Transition};
pub use correct::{Corrected, CorrectionModel, Outcome, Outcomes, correct};
pub use delayed::{triangulated, with_ray};
pub use error::LandingError;
pub use files::{write_covariance_csv, write_estimate_csv};
pub use imu::{GAP_FORCE_SIGMA_M_S2, GAP_RATE_SIGMA_RAD_S, ImuIncrement, ImuRecord, LONGEST_GAP_S};
pub use initialize::{InitializationModel, initial_estimate, with_landmark, with_landmark_at_height, without_landmark};
pub use input::{KnownSighting, LandingInput};
pub use measurement::{BearingObservation, CameraMount, KnownPoint};
pub use navigate::navigate;
pub use planet::Planet;
pub use predict::{Core, predict};
pub use recovery::Contradiction;
pub use result::{ImuGap, LandingEpoch, LandingResult};
pub use rotation::{ImageRotation, ImageRotationUse, RotationCheck};
pub use state::{DescentEstimate, DescentState, ImuBiases, LandmarkRole, UnknownLandmark};
pub use step::{FrameInput, Navigator, StepReport, step};
