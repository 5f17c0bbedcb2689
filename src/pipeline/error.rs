//! Whatever can stop a story, in one type.

use crate::dataset::DatasetError;
use crate::evaluation::EvaluationError;
use crate::navigation::landing::LandingError;
use crate::navigation::tumbling::TumblingError;
#[cfg(feature = "render")]
use crate::render::RenderError;
#[cfg(feature = "report")]
use crate::report::ReportError;
#[cfg(feature = "scene")]
use crate::scene::SceneError;
use crate::settings::{OutOfRange, SettingsError};
#[cfg(feature = "vision")]
use crate::vision::VisionError;
use std::path::PathBuf;
use thiserror::Error;

/// Why a story could not be told to its end. Every message names the file or key and the cure. Rooms that the build leaves
/// out have no variant.
#[derive(Debug, Error)]
pub enum PipelineError {
    /// Settings that cannot be read.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// A setting outside its range.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    /// Files.
    #[error(transparent)]
    Dataset(#[from] DatasetError),
    /// The scenario.
    #[cfg(feature = "scene")]
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The renderer.
    #[cfg(feature = "render")]
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The image front end.
    #[cfg(feature = "vision")]
    #[error(transparent)]
    Vision(#[from] VisionError),
    /// The landing estimator.
    #[error(transparent)]
    Landing(#[from] LandingError),
    /// The tumbling estimator.
    #[error(transparent)]
    Tumbling(#[from] TumblingError),
    /// The comparison with the truth.
    #[error(transparent)]
    Evaluation(#[from] EvaluationError),
    /// The page.
    #[cfg(feature = "report")]
    #[error(transparent)]
    Report(#[from] ReportError),
    /// The output folder holds something already.
    #[error("{} is not empty: continue it with --resume, or name another folder", path.display())]
    NotEmpty {
        /// The folder.
        path: PathBuf,
    },
    /// A folder holds a different job.
    #[error("{} holds another scenario: name another folder, or resume with the same scenario, seed and settings", path.display())]
    OtherScenario {
        /// The folder.
        path: PathBuf,
    },
    /// A folder holds images that another adapter or version drew.
    #[error(
        "{} was begun by {found}, and {maker} may draw other bytes: resume with the same adapter (--adapter), or name \
         another folder",
        path.display()
    )]
    OtherMaker {
        /// The folder.
        path: PathBuf,
        /// Version and adapter that began it.
        found: String,
        /// This version and adapter.
        maker: String,
    },
    /// Only a descent has a landing area to map.
    #[error("{} has no table [descent], and a map is made of a descent's landing area: name another scenario", path.display())]
    NoDescent {
        /// The scenario file.
        path: PathBuf,
    },
    /// A range of frames that does not fit.
    #[error("frames {from}..{to} do not lie within the {available} frames there are")]
    FrameRange {
        /// First frame.
        from: usize,
        /// One past the last frame.
        to: usize,
        /// Number of frames.
        available: usize,
    },
}
