//! Arguments of the subcommands that read images.

use super::arguments::{put, word};
use super::frame_range::frame_range;
use opnav::pipeline::{DescriptorKind, DetectorKind, FrontEndConfig, InputSettings};
use std::ops::Range;
use std::path::PathBuf;

/// Which images of a folder are taken, and what is known of them.
#[derive(Debug, clap::Args)]
pub struct InputArguments {
    /// Camera file in EuRoC's form [default: `sensor.yaml` of the folder].
    #[arg(long, value_name = "SENSOR.YAML", conflicts_with = "fov_deg")]
    camera: Option<PathBuf>,
    /// Horizontal field of view in degrees of a pinhole camera without distortion.
    #[arg(long, value_name = "DEG", value_parser = field_of_view_deg)]
    fov_deg: Option<f64>,
    /// List of `timestamp [ns],filename` for images whose names are no time stamps.
    #[arg(long, value_name = "LIST.CSV", conflicts_with = "rate_hz")]
    times: Option<PathBuf>,
    /// Images a second, in the order of their names.
    #[arg(long, value_name = "HZ", value_parser = positive_number)]
    rate_hz: Option<f64>,
    /// Take every N-th image [default: 1].
    #[arg(long, value_name = "N", value_parser = positive)]
    every: Option<usize>,
    /// Images to take, counted from 0, without B.
    #[arg(long, value_name = "A..B", value_parser = frame_range)]
    frames: Option<Range<usize>>,
    /// Grey image of 8 bits and the camera's size, 0 where not to look (parts of the spacecraft).
    #[arg(long, value_name = "FILE")]
    mask: Option<PathBuf>,
}

impl InputArguments {
    /// Puts what is given over the settings.
    pub fn apply(&self, input: &mut InputSettings) {
        if self.camera.is_some() || self.fov_deg.is_some() {
            (input.camera, input.fov_deg) = (self.camera.clone(), self.fov_deg);
        }
        if self.times.is_some() || self.rate_hz.is_some() {
            (input.times, input.rate_hz) = (self.times.clone(), self.rate_hz);
        }
        put(&mut input.every, self.every);
        if let Some(frames) = &self.frames {
            input.frames = Some([frames.start, frames.end]);
        }
        if self.mask.is_some() {
            input.mask.clone_from(&self.mask);
        }
    }
}

/// How images are tracked.
#[derive(Debug, clap::Args)]
pub struct FrontEndArguments {
    /// What finds features [default: harris].
    #[arg(long, value_parser = word::<DetectorKind>())]
    detector: Option<DetectorKind>,
    /// What describes a feature when it is matched [default: orb].
    #[arg(long, value_parser = word::<DescriptorKind>())]
    descriptor: Option<DescriptorKind>,
}

impl FrontEndArguments {
    /// Puts what is given over the settings.
    pub fn apply(&self, config: &mut FrontEndConfig) {
        put(&mut config.detector.kind, self.detector);
        put(&mut config.matcher.descriptor, self.descriptor);
    }
}

/// Parses a field of view in degrees, between 0 and 180.
pub fn field_of_view_deg(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(fov) if fov > 0.0 && fov < 180.0 => Ok(fov),
        _ => Err(format!("'{text}' is not an angle between 0 and 180 degrees")),
    }
}

/// Parses a positive number.
pub fn positive_number(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number > 0.0 && number.is_finite() => Ok(number),
        _ => Err(format!("'{text}' is not a positive number")),
    }
}

/// Parses a whole number from 1.
pub fn positive(text: &str) -> Result<usize, String> {
    text.parse::<usize>().ok().filter(|n| *n > 0).ok_or_else(|| format!("'{text}' is not a whole number from 1"))
}
