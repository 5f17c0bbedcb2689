//! Why an evaluation could not be made.

use crate::dataset::DatasetError;
use crate::settings::OutOfRange;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why a result could not be compared with the truth.
#[derive(Debug, Error)]
pub enum EvaluationError {
    /// A file could not be read or written.
    #[error(transparent)]
    File(#[from] DatasetError),
    /// A result table lacks a column.
    #[error("{} has no column '{column}': its columns are {found}", path.display())]
    MissingColumn {
        /// The table.
        path: PathBuf,
        /// Name of the column.
        column: String,
        /// The names that are there.
        found: String,
    },
    /// The data set holds no truth.
    #[error("{} has no folder 'truth': give the data set that the result was made from, rendered by opnav", path.display())]
    NoTruth {
        /// The folder given as the data set.
        path: PathBuf,
    },
    /// Result and truth share no moment.
    #[error(
        "no time of {} lies within the truth of {}: the result was made from another data set",
        result.display(),
        truth.display()
    )]
    NoCommonTime {
        /// The result's file.
        result: PathBuf,
        /// The truth's folder.
        truth: PathBuf,
    },
    /// An option of a campaign is out of range.
    #[error("campaign option {0}")]
    OutOfRange(#[from] OutOfRange),
}

impl EvaluationError {
    /// That the estimates of a result share no moment with the truth of a data set.
    pub(super) fn no_common_time(result: &Path, root: &Path) -> Self {
        EvaluationError::NoCommonTime { result: result.join("estimate.csv"), truth: root.join("truth") }
    }
}
