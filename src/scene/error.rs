//! Everything that can be wrong with a scenario or a shape, each error naming the file or key and the cure.

use crate::settings::{OutOfRange, SettingsError};
use std::fmt::Display;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why a scene could not be described or built.
#[derive(Debug, Error)]
pub enum SceneError {
    /// The operating system refused.
    #[error("could not {action} {}: {source}", path.display())]
    Io {
        /// What was being done, such as `"read"`.
        action: &'static str,
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// A line of a file is not what it should be.
    #[error("{}, line {line}: {problem}", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// Line number from 1.
        line: u64,
        /// What is wrong and what to do.
        problem: String,
    },
    /// The content of a file is not usable as a whole.
    #[error("{}: {problem}", path.display())]
    Unusable {
        /// The file.
        path: PathBuf,
        /// What is wrong and what to do.
        problem: String,
    },
    /// A setting outside its range, or one that contradicts another.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    /// Settings that cannot be read.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// A mesh that is no solid body.
    #[error("the mesh {problem}")]
    NotSolid {
        /// What is wrong and what to do.
        problem: String,
    },
}

impl SceneError {
    /// A setting outside its range.
    pub fn out_of_range(key: &str, value: impl Display, cure: impl Display) -> Self {
        OutOfRange::new(key, value, cure).into()
    }

    /// Puts the name of the enclosing table before the key.
    pub(super) fn under(self, table: &str) -> Self {
        match self {
            SceneError::OutOfRange(fault) => fault.under(table).into(),
            other => other,
        }
    }

    /// Names the file that a setting or a mesh comes from; errors that name a file already stay as they are.
    pub(super) fn in_file(self, path: &Path) -> Self {
        match self {
            SceneError::OutOfRange(_) | SceneError::NotSolid { .. } => {
                SceneError::Unusable { path: path.into(), problem: self.to_string() }
            }
            other => other,
        }
    }
}
