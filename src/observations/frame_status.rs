//! What became of an image.

use serde::{Deserialize, Serialize};

/// What became of one frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FrameStatus {
    /// Its features were used.
    #[default]
    Ok,
    /// Too few features for a pair: dark, saturated, or without texture.
    NoFeatures,
    /// Its size is not the camera's.
    WrongSize,
    /// The file is missing or damaged.
    Unreadable,
}

impl FrameStatus {
    /// The outcome's word in files.
    pub fn word(self) -> &'static str {
        match self {
            FrameStatus::Ok => "ok",
            FrameStatus::NoFeatures => "no-features",
            FrameStatus::WrongSize => "wrong-size",
            FrameStatus::Unreadable => "unreadable",
        }
    }
}
