//! Everything that can be wrong with files, each error naming the file and the cure.

use std::path::PathBuf;
use thiserror::Error;

/// Why a data set or result file could not be read or written.
#[derive(Debug, Error)]
pub enum DatasetError {
    /// The operating system refused.
    #[error("could not {action} {}: {source}", path.display())]
    Io {
        /// What was being done, such as `"read"`.
        action: &'static str,
        /// The file or folder.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// A file or folder that has to be there is not.
    #[error("{} is missing: {cure}", path.display())]
    Missing {
        /// The file or folder.
        path: PathBuf,
        /// What to do.
        cure: String,
    },
    /// The text of a file is not what it should be.
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
        /// The file or folder.
        path: PathBuf,
        /// What is wrong and what to do.
        problem: String,
    },
    /// An image of the wrong size.
    #[error(
        "{} is {found_width_px}x{found_height_px} px, but its camera is {width_px}x{height_px} px: give the \
         camera file of these pictures or remove the picture",
        path.display()
    )]
    WrongSize {
        /// The image.
        path: PathBuf,
        /// Its width in px.
        found_width_px: u32,
        /// Its height in px.
        found_height_px: u32,
        /// The camera's width in px.
        width_px: u32,
        /// The camera's height in px.
        height_px: u32,
    },
}

impl DatasetError {
    /// Wraps an operating-system error with what was being done to which path.
    pub fn io(action: &'static str, path: impl Into<PathBuf>) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.into();
        move |source| DatasetError::Io { action, path, source }
    }
}
