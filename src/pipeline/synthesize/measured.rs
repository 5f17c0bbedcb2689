//! What is known of the measured ground under a descent.

use crate::dataset::write_text;
use crate::pipeline::error::PipelineError;
use crate::pipeline::progress::Progress;
use crate::scene::{ElevationSummary, Scene};
use std::path::Path;

/// Writes `truth/elevation.json`, if the ground of the scene has an elevation model under it.
pub(super) fn write_elevation(root: &Path, scene: &Scene) -> Result<(), PipelineError> {
    let Some(summary) = elevation_of(scene) else { return Ok(()) };
    let text = serde_json::to_string_pretty(summary).expect("a summary is plain data");
    Ok(write_text(&root.join("truth/elevation.json"), &text)?)
}

/// Tells how many posts of the elevation model had to be filled, if any.
pub(super) fn note_filled_posts(scene: &Scene, progress: &dyn Progress) {
    let Some(ElevationSummary { filled_posts: filled @ 1.., posts: [columns, rows], .. }) = elevation_of(scene) else {
        return;
    };
    let share = 100.0 * *filled as f64 / (columns * rows) as f64;
    progress.note(&format!(
        "{filled} of {columns} × {rows} posts of the elevation model ({share:.1} %) hold no data: filled from around them"
    ));
}

fn elevation_of(scene: &Scene) -> Option<&ElevationSummary> {
    let Scene::Descent(descent) = scene else { return None };
    Some(descent.terrain.base()?.elevation.as_ref()?.summary())
}
