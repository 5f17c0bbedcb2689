//! Arguments that several subcommands share.

use clap::ValueEnum;
use opnav::pipeline::{CameraSource, DescriptorKind, FrontEndConfig};
use std::ops::Range;
use std::path::PathBuf;

/// Parses `A..B`: frames from A, counted from 0, up to and without B.
pub fn frame_range(text: &str) -> Result<Range<usize>, String> {
    let expected = || format!("'{text}' is not A..B with whole numbers A < B (frames count from 0, B is left out)");
    let (from, to) = text.split_once("..").ok_or_else(expected)?;
    let from: usize = from.trim().parse().map_err(|_| expected())?;
    let to: usize = to.trim().parse().map_err(|_| expected())?;
    if from < to { Ok(from..to) } else { Err(expected()) }
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

/// Where the camera's parameters come from.
#[derive(Debug, clap::Args)]
pub struct CameraArguments {
    /// Camera file in EuRoC's form; by default `sensor.yaml` of the folder.
    #[arg(long, value_name = "SENSOR.YAML", conflicts_with = "fov_deg")]
    camera: Option<PathBuf>,
    /// Horizontal field of view in degrees of a pinhole camera without distortion.
    #[arg(long, value_name = "DEG", value_parser = field_of_view_deg)]
    fov_deg: Option<f64>,
}

impl CameraArguments {
    /// The source that the arguments name.
    pub fn source(&self) -> CameraSource {
        match (&self.camera, self.fov_deg) {
            (Some(path), _) => CameraSource::File(path.clone()),
            (None, Some(fov_deg)) => CameraSource::HorizontalFov(fov_deg.to_radians()),
            (None, None) => CameraSource::Folder,
        }
    }
}

/// How pictures are tracked.
#[derive(Debug, clap::Args)]
pub struct FrontEndArguments {
    /// What describes a feature when it is matched.
    #[arg(long, value_enum, default_value = "orb")]
    descriptor: DescriptorName,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum DescriptorName {
    /// Comparisons of grey levels: quick.
    Orb,
    /// Sums of gradients: slower, for pictures that differ much.
    Sift,
}

impl FrontEndArguments {
    /// Settings with these arguments.
    pub fn applied_to(&self, mut config: FrontEndConfig) -> FrontEndConfig {
        config.matcher.descriptor = match self.descriptor {
            DescriptorName::Orb => DescriptorKind::Orb,
            DescriptorName::Sift => DescriptorKind::Sift,
        };
        config
    }
}
