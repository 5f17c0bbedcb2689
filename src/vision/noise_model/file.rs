//! The file that holds the constants.

use super::model::NoiseModel;
use crate::vision::error::VisionError;
use serde::{Deserialize, Serialize};
use std::sync::LazyLock;

/// A number of the noise model with where it comes from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Constant {
    /// The number, in the unit of its key.
    pub value: f64,
    /// The number's 95 % interval over other scenes of the same kind (bootstrap); none where it was not fitted.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub interval_95: Option<[f64; 2]>,
    /// Independent samples that the fit rests on; 0 where it was not fitted.
    pub samples: usize,
    /// How it was found: criterion, scenes and what was measured on them.
    pub source: String,
    /// Where it was found and so may be trusted: noise, blur, height, change of view, phase.
    pub validity: String,
}

/// The noise model as it stands in a file, and how that file was made.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NoiseModelFile {
    /// Layout of the file, 1.
    pub format: u32,
    /// What wrote it.
    pub command: String,
    /// Day of the run that found the numbers, year-month-day.
    pub date: String,
    /// Seed of the bootstrap and of perturbed predictions.
    pub seed: u64,
    /// Scenarios that were rendered.
    pub scenes: Vec<String>,
    /// Every constant.
    pub constants: NoiseModel<Constant>,
}

/// The file that is part of the library.
static EMBEDDED: LazyLock<NoiseModelFile> =
    LazyLock::new(|| NoiseModelFile::parse(NoiseModelFile::EMBEDDED).expect("the library's own noise model is usable"));

impl Default for NoiseModelFile {
    /// The file that is part of the library.
    fn default() -> Self {
        EMBEDDED.clone()
    }
}

impl Default for NoiseModel {
    /// The numbers of the file that is part of the library.
    fn default() -> Self {
        NoiseModelFile::default().constants.map(|constant: &Constant| constant.value)
    }
}

impl NoiseModelFile {
    /// Text of the file that is part of the library.
    pub const EMBEDDED: &str = include_str!("noise_model.toml");
    const FORMAT: u32 = 1;

    /// Reads a noise model from TOML; every constant has to be there, and no other.
    ///
    /// # Errors
    /// [`VisionError::NoiseModel`] or [`VisionError::OutOfRange`] names the key.
    pub fn parse(text: &str) -> Result<Self, VisionError> {
        let file: NoiseModelFile =
            toml::from_str(text).map_err(|error| VisionError::NoiseModel { problem: error.to_string() })?;
        if file.format != Self::FORMAT {
            let problem = format!("format is {} and has to be {}", file.format, Self::FORMAT);
            return Err(VisionError::NoiseModel { problem });
        }
        file.constants().validate()?;
        Ok(file)
    }

    /// The numbers alone.
    pub fn constants(&self) -> NoiseModel {
        self.constants.map(|constant| constant.value)
    }
}
