//! `summary.json`: what a result is and how it came about.

use super::error::PipelineError;
use crate::dataset::write_text;
use crate::observations::FrameStatus;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::Path;

/// The head of a result folder.
#[derive(Debug, Clone, Serialize)]
pub struct Summary {
    /// `landing`, `tumbling`, `tracking` or `landing-campaign`.
    pub mission: &'static str,
    /// Version of opnav.
    pub opnav_version: &'static str,
    /// Time of the first image used, ns.
    pub t0_ns: Option<i64>,
    /// Every option as used.
    pub options: serde_json::Value,
    /// Frames, matches, and whatever else was counted.
    pub counts: BTreeMap<String, usize>,
    /// Final estimates with their 1σ, units in the names.
    #[serde(rename = "final")]
    pub last: serde_json::Value,
    /// Wall time of each stage in ms.
    pub timing_ms: BTreeMap<String, f64>,
    /// Frames that could not be used, and why.
    pub frames_not_used: Vec<UnusedFrame>,
    /// What the user should know: coasted intervals, undetermined quantities.
    pub notes: Vec<String>,
}

/// A frame that could not be used.
#[derive(Debug, Clone, Serialize)]
pub struct UnusedFrame {
    /// Position in the sequence, from 0.
    pub index: usize,
    /// Time in ns.
    pub t_ns: i64,
    /// The image's file.
    pub file: String,
    /// What became of it.
    pub status: FrameStatus,
    /// What is wrong with the file and what to do, if anything.
    pub problem: Option<String>,
}

impl Summary {
    /// A summary with nothing in it yet.
    pub fn new(mission: &'static str, options: serde_json::Value) -> Self {
        Summary {
            mission,
            opnav_version: env!("CARGO_PKG_VERSION"),
            t0_ns: None,
            options,
            counts: BTreeMap::new(),
            last: serde_json::Value::Null,
            timing_ms: BTreeMap::new(),
            frames_not_used: Vec::new(),
            notes: Vec::new(),
        }
    }

    /// Writes `summary.json` into a result folder.
    ///
    /// # Errors
    /// Names the file that could not be written.
    pub fn write(&self, folder: &Path) -> Result<(), PipelineError> {
        let text = serde_json::to_string_pretty(self).expect("a summary is plain data");
        Ok(write_text(&folder.join("summary.json"), &text)?)
    }
}
