//! Which images are taken, and what is known of them.

use crate::dataset::{CameraSource, FrameTimes};
use crate::settings::{OutOfRange, limits};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::ops::Range;
use std::path::PathBuf;

/// Which images of a folder are taken, and what is known of them besides what the folder says. Paths are relative to the
/// folder in which the command runs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct InputSettings {
    /// Camera file in EuRoC's form (default: `sensor.yaml` of the folder).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera: Option<PathBuf>,
    /// Horizontal field of view in degrees of a pinhole camera without distortion, between 0 and 180 (default: what the
    /// camera file says).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fov_deg: Option<f64>,
    /// List of `timestamp [ns],filename` for images whose names are no time stamps (default: the folder's own).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub times: Option<PathBuf>,
    /// Images a second, in the order of their names, above 0 (default: by their time stamps).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rate_hz: Option<f64>,
    /// Every n-th image is taken, 1 or more (default 1).
    pub every: usize,
    /// The first image and the one after the last, counted from 0 (default: all).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frames: Option<[usize; 2]>,
    /// Grey image of 8 bits and the camera's size, 0 where not to look (default: none).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mask: Option<PathBuf>,
}

impl Default for InputSettings {
    fn default() -> Self {
        InputSettings { camera: None, fov_deg: None, times: None, rate_hz: None, every: 1, frames: None, mask: None }
    }
}

impl InputSettings {
    /// Where the camera's parameters come from.
    pub fn camera_source(&self) -> CameraSource {
        match (&self.camera, self.fov_deg) {
            (Some(path), _) => CameraSource::File(path.clone()),
            (None, Some(fov_deg)) => CameraSource::HorizontalFov(fov_deg.to_radians()),
            (None, None) => CameraSource::Folder,
        }
    }

    /// Where the time stamps come from.
    pub fn frame_times(&self) -> FrameTimes {
        match (&self.times, self.rate_hz) {
            (Some(path), _) => FrameTimes::List(path.clone()),
            (None, Some(rate_hz)) => FrameTimes::RateHz(rate_hz),
            (None, None) => FrameTimes::Folder,
        }
    }

    /// The images to take; all if `None`.
    pub fn frame_range(&self) -> Option<Range<usize>> {
        self.frames.map(|[from, to]| from..to)
    }

    /// Checks every range.
    ///
    /// # Errors
    /// Names the key.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        if let Some(fov_deg) = self.fov_deg {
            limits::between("fov_deg", fov_deg, 0.0, 180.0)?;
            if self.camera.is_some() {
                return Err(OutOfRange::new("fov_deg", fov_deg, "a camera file is given too: drop one of them"));
            }
        }
        if let Some(rate_hz) = self.rate_hz {
            limits::positive("rate_hz", rate_hz)?;
            if self.times.is_some() {
                return Err(OutOfRange::new("rate_hz", rate_hz, "a list of times is given too: drop one of them"));
            }
        }
        limits::count_from("every", self.every, 1)?;
        match self.frames {
            Some([from, to]) if from >= to => {
                Err(OutOfRange::new("frames", format!("{from}, {to}"), "the first must be below the second"))
            }
            _ => Ok(()),
        }
    }
}
