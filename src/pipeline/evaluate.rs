//! A result against the truth.

use super::error::PipelineError;
use crate::evaluation::{Metrics, evaluate};
use std::path::Path;

/// Compares a result folder with a data set's truth and writes `metrics.json` into the result.
///
/// # Errors
/// Missing or malformed files on either side.
pub fn evaluate_result(result: &Path, truth: &Path) -> Result<Metrics, PipelineError> {
    Ok(evaluate(result, truth)?)
}
