//! Why a report could not be made.

use crate::dataset::DatasetError;
use crate::evaluation::EvaluationError;
use thiserror::Error;

/// Why a report could not be made.
#[derive(Debug, Error)]
pub enum ReportError {
    /// A file could not be read or written.
    #[error(transparent)]
    File(#[from] DatasetError),
    /// A result could not be read.
    #[error(transparent)]
    Result(#[from] EvaluationError),
    /// An image could not be encoded.
    #[error("could not encode a picture as PNG: {0}")]
    PageImage(#[from] image::ImageError),
    /// A plot could not be drawn.
    #[error("could not draw the plot '{title}': {problem}")]
    Plot {
        /// The plot's title.
        title: String,
        /// The plotter's reason.
        problem: String,
    },
}
