//! Arguments that several subcommands share.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use opnav::pipeline::{DescriptorKind, DetectorKind, FrontEndConfig, InputSettings};
use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use serde_json::Value;
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

/// Parses numbers with commas between them.
pub fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let found: Result<Vec<f64>, _> = text.split(',').map(|number| number.trim().parse()).collect();
    let numbers = found.ok().and_then(|numbers| numbers.try_into().ok());
    numbers.ok_or_else(|| format!("'{text}' is not {N} numbers with commas between them"))
}

/// Parses one of the words of a choice, each explained by the documentation of its value.
pub fn word<T: JsonSchema + DeserializeOwned + Clone + Send + Sync + 'static>() -> impl TypedValueParser<Value = T> {
    let schema = schemars::schema_for!(T).to_value();
    let text = |value: &Value| value.as_str().unwrap_or_default().trim_end_matches('.').to_string();
    let values = schema["oneOf"].as_array().into_iter().flatten();
    // The parser keeps words for as long as the program runs, and is made once.
    let words: Vec<PossibleValue> = values
        .map(|value| PossibleValue::new(text(&value["const"]).leak() as &str).help(text(&value["description"])))
        .collect();
    PossibleValuesParser::new(words).map(|word| serde_json::from_value(word.into()).expect("one of the possible words"))
}

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

/// Puts what is given in the place of a setting.
pub fn put<T: Copy>(setting: &mut T, given: Option<T>) {
    if let Some(value) = given {
        *setting = value;
    }
}
