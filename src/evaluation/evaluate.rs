//! One result against the truth of its data set.

use super::error::EvaluationError;
use super::ground::{TrackedPixel, read_tracks};
use super::landing::evaluate_landing;
use super::metrics::Metrics;
use super::pairs::evaluate_pairs;
use super::summary::{Mission, Summary};
use super::tracks::evaluate_tracks;
use super::true_camera::TrueCamera;
use super::tumbling::evaluate_tumbling;
use crate::dataset::DatasetError;
use std::path::Path;

/// Compares a result folder with the truth of the data set in `truth_folder` (the folder that holds `truth/`), writes
/// `metrics.json` and `metrics_series.json` into the result, and returns both.
///
/// # Errors
/// Names the file at fault, a missing column or truth, and a result that shares no time with the truth.
pub fn evaluate(result_folder: &Path, truth_folder: &Path) -> Result<Metrics, EvaluationError> {
    let summary = Summary::read(result_folder)?;
    if !truth_folder.join("truth").is_dir() {
        return Err(EvaluationError::NoTruth { path: truth_folder.into() });
    }
    let tracks = read_tracks(result_folder)?;
    let mut metrics = Metrics::new(summary.mission);
    match summary.mission {
        Mission::Landing => evaluate_landing(result_folder, truth_folder, &tracks, &mut metrics)?,
        Mission::Tumbling => {
            let start_ns = summary.integer("t0_ns").or_else(|| first_time(&tracks));
            evaluate_tumbling(result_folder, truth_folder, start_ns, &mut metrics)?;
        }
        Mission::Tracking => {}
    }
    evaluate_front_end(result_folder, truth_folder, &tracks, &mut metrics)?;
    metrics.write(result_folder)?;
    Ok(metrics)
}

fn first_time(tracks: &[TrackedPixel]) -> Option<i64> {
    tracks.iter().map(|seen| seen.t_ns).min()
}

/// Pairs and tracks; a mission can do without the true camera, tracking alone cannot.
fn evaluate_front_end(
    result: &Path,
    root: &Path,
    tracks: &[TrackedPixel],
    metrics: &mut Metrics,
) -> Result<(), EvaluationError> {
    let camera = match TrueCamera::read(root) {
        Ok(camera) => camera,
        Err(EvaluationError::File(error @ DatasetError::Missing { .. })) if metrics.mission != Mission::Tracking => {
            metrics.note(format!("Pairs and tracks are not judged: {error}."));
            return Ok(());
        }
        Err(error) => return Err(error),
    };
    evaluate_pairs(result, &camera, camera.start_ns(), metrics)?;
    evaluate_tracks(tracks, &camera, camera.start_ns(), metrics)
}
