//! Everything that can go wrong in the front end.

use crate::dataset::DatasetError;
use crate::settings::OutOfRange;
use thiserror::Error;

/// Why the front end could not do its work.
#[derive(Debug, Error)]
pub enum VisionError {
    /// An image or file at fault.
    #[error(transparent)]
    Dataset(#[from] DatasetError),
    /// Too few images for a pair.
    #[error("at least two pictures are needed, and {found} selected: check the folder and the range of frames")]
    TooFewImages {
        /// Images selected.
        found: usize,
    },
    /// Images were selected, but nearly none of them can be used.
    #[error(
        "at least two pictures are needed, and {found} of the {selected} selected can be used; the first fault: {problem}"
    )]
    TooFewUsable {
        /// Images that can be used.
        found: usize,
        /// Images selected.
        selected: usize,
        /// What is wrong with the first of the others, and what to do.
        problem: String,
    },
    /// A setting outside its range.
    #[error("front-end setting {0}")]
    OutOfRange(#[from] OutOfRange),
    /// A noise model that cannot be read.
    #[error("the noise model is not usable: {problem}")]
    NoiseModel {
        /// What is wrong, with the key.
        problem: String,
    },
    /// A mask of another size than its image.
    #[error("the mask is {mask_width_px}x{mask_height_px} px, but its picture is {width_px}x{height_px} px")]
    MaskSize {
        /// The mask's width in px.
        mask_width_px: u32,
        /// The mask's height in px.
        mask_height_px: u32,
        /// The image's width in px.
        width_px: u32,
        /// The image's height in px.
        height_px: u32,
    },
    /// A mask without a place to look at.
    #[error("the mask leaves nothing to look at: 0 says where not to look, any other number where to look")]
    MaskCoversAll,
    /// OpenCV refused.
    #[error("OpenCV could not {action}: {source}")]
    OpenCv {
        /// What was being done.
        action: &'static str,
        /// OpenCV's reason.
        source: opencv::Error,
    },
}

impl VisionError {
    pub(super) fn opencv(action: &'static str) -> impl FnOnce(opencv::Error) -> Self {
        move |source| VisionError::OpenCv { action, source }
    }
}
