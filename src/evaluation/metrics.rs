//! The outcome of an evaluation: figures with units, verdicts, and curves over time.

use super::error::EvaluationError;
use super::summary::Mission;
use crate::dataset::{DatasetError, write_text};
use crate::stats::ConsistencyBounds;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// One number with its unit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Figure {
    /// What it is, in snake case.
    pub name: String,
    /// The value, always finite.
    pub value: f64,
    /// Its unit; `1` for a ratio or a count.
    pub unit: String,
    /// The χ² bounds that the value has to keep, where there are any.
    pub bound: Option<ConsistencyBounds>,
}

/// A yes or no with its reason.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Verdict {
    /// What is judged, in snake case.
    pub name: String,
    /// Whether it holds.
    pub holds: bool,
    /// Why, in one sentence.
    pub reason: String,
}

/// A curve over time.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Series {
    /// What it is, in snake case.
    pub name: String,
    /// Unit of the values.
    pub unit: String,
    /// Time since the start of the truth in s.
    pub t_s: Vec<f64>,
    /// The values, one a time.
    pub values: Vec<f64>,
    /// The estimator's own 1σ, one a time; empty where it gives none.
    pub sigma: Vec<f64>,
    /// The χ² bounds of one value, where there are any.
    pub bound: Option<ConsistencyBounds>,
}

/// Everything that an evaluation found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Metrics {
    /// What was estimated.
    pub mission: Mission,
    /// The figures.
    pub figures: Vec<Figure>,
    /// The verdicts.
    pub verdicts: Vec<Verdict>,
    /// What could not be computed and why, and how to read what was.
    pub notes: Vec<String>,
    /// Curves for plots; in `metrics_series.json`.
    #[serde(skip)]
    pub series: Vec<Series>,
}

impl Metrics {
    /// Metrics without content.
    pub fn new(mission: Mission) -> Self {
        Metrics { mission, figures: vec![], verdicts: vec![], notes: vec![], series: vec![] }
    }

    /// Adds a figure; one that is missing or not finite becomes a note.
    pub fn add(&mut self, name: &str, value: impl Into<Option<f64>>, unit: &str) {
        self.add_bounded(name, value, unit, None);
    }

    /// Adds a figure that has to keep bounds.
    pub fn add_bounded(
        &mut self,
        name: &str,
        value: impl Into<Option<f64>>,
        unit: &str,
        bound: Option<ConsistencyBounds>,
    ) {
        match value.into().filter(|v| v.is_finite()) {
            Some(value) => self.figures.push(Figure { name: name.into(), value, unit: unit.into(), bound }),
            None => self.note(format!("{name} cannot be computed from these files.")),
        }
    }

    /// Adds the number of epochs that can be judged, and a note where some lie outside the truth's time.
    pub(super) fn add_epochs(&mut self, judged: usize, all: usize) {
        if judged < all {
            self.note(format!("{} of {all} epochs lie outside the truth's time.", all - judged));
        }
        self.add("epochs", judged as f64, "1");
    }

    /// Adds a note.
    pub fn note(&mut self, text: impl Into<String>) {
        self.notes.push(text.into());
    }

    /// The value of a figure.
    pub fn figure(&self, name: &str) -> Option<f64> {
        self.figures.iter().find(|f| f.name == name).map(|f| f.value)
    }

    /// A curve.
    pub fn series(&self, name: &str) -> Option<&Series> {
        self.series.iter().find(|s| s.name == name)
    }

    /// A verdict.
    pub fn verdict(&self, name: &str) -> Option<&Verdict> {
        self.verdicts.iter().find(|v| v.name == name)
    }

    /// Writes `metrics.json` and `metrics_series.json` into a result folder.
    ///
    /// # Errors
    /// Names the file that could not be written.
    pub fn write(&self, result_folder: &Path) -> Result<(), EvaluationError> {
        let figures = serde_json::to_string_pretty(self).expect("metrics are plain data");
        write_text(&result_folder.join("metrics.json"), &figures)?;
        let series = serde_json::to_string(&self.series).expect("series are plain data");
        Ok(write_text(&result_folder.join("metrics_series.json"), &series)?)
    }

    /// Reads what [`Metrics::write`] wrote.
    ///
    /// # Errors
    /// Names the file that is missing or malformed.
    pub fn read(result_folder: &Path) -> Result<Self, EvaluationError> {
        let mut metrics: Metrics = read_json(&result_folder.join("metrics.json"))?;
        metrics.series = read_json(&result_folder.join("metrics_series.json"))?;
        Ok(metrics)
    }
}

fn read_json<T: serde::de::DeserializeOwned>(path: &Path) -> Result<T, DatasetError> {
    if !path.is_file() {
        let cure = "run 'opnav evaluate' on the result first".into();
        return Err(DatasetError::Missing { path: path.into(), cure });
    }
    let text = std::fs::read_to_string(path).map_err(DatasetError::io("read", path))?;
    serde_json::from_str(&text).map_err(|e| DatasetError::Unusable { path: path.into(), problem: e.to_string() })
}
