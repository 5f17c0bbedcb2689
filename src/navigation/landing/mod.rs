//! Vision-aided inertial navigation of a lander: one known landmark (the designated landing point, the origin of the
//! `site` frame) and a few unknown ones, each chosen for what its observation will tell.
//!
//! [`navigate`] runs a whole descent; [`step`] is one frame of it and reads as the paper reads (Li et al. 2023). The
//! filter comes in two forms that differ only in the coordinates of the error: [`FilterKind::Hybrid`], which stays
//! consistent because nothing in it can pretend to observe yaw, and [`FilterKind::Standard`], the paper's own.

mod candidates;
mod config;
mod coordinates;
mod correct;
mod designated;
mod error;
mod files;
mod hybrid;
mod imu;
mod initialize;
mod input;
mod measurement;
mod navigate;
mod predict;
mod recovery;
mod result;
mod select;
mod standard;
mod state;
mod step;

pub use candidates::{LookAhead, survives, viewpoint};
pub use config::{FilterKind, LandingConfig};
pub use coordinates::{LandmarkJacobians, Transition};
pub use correct::{Corrected, CorrectionModel, Outcome, correct, innovation};
pub use error::LandingError;
pub use files::{write_covariance_csv, write_estimate_csv};
pub use imu::{ImuIncrement, ImuRecord};
pub use initialize::{InitializationModel, initial_estimate, with_landmark, without_landmark};
pub use input::LandingInput;
pub use measurement::{BearingObservation, CameraMount};
pub use navigate::navigate;
pub use predict::predict;
pub use recovery::Contradiction;
pub use result::{LandingEpoch, LandingResult};
pub use state::{DescentEstimate, DescentState, UnknownLandmark};
pub use step::{FrameInput, Navigator, StepReport, step};
