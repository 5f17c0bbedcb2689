//! How well tracks stay on their surface points, by true depth and pose.

use super::error::EvaluationError;
use super::ground::TrackedPixel;
use super::metrics::{Metrics, Series};
use super::spread::{median, percentile};
use super::true_camera::TrueCamera;
use std::collections::{BTreeMap, HashMap};

/// Adds the error of every track that was seen in two successive frames: the first pixel, carried over by the true depth
/// and poses, less the second, in px.
pub fn evaluate_tracks(
    tracks: &[TrackedPixel],
    camera: &TrueCamera,
    start_ns: i64,
    metrics: &mut Metrics,
) -> Result<(), EvaluationError> {
    if tracks.is_empty() {
        metrics.note("There is no tracks.csv, so no track is judged.");
        return Ok(());
    }
    let mut frames: BTreeMap<i64, Vec<&TrackedPixel>> = BTreeMap::new();
    for seen in tracks {
        frames.entry(seen.t_ns).or_default().push(seen);
    }
    metrics.add("tracked_frames", frames.len() as f64, "1");
    metrics.add("tracks_per_frame_median", median(&frames.values().map(|f| f.len() as f64).collect::<Vec<_>>()), "1");
    let frames: Vec<_> = frames.into_iter().collect();
    let (mut all_px, mut series) =
        (vec![], Series { name: "track_error_median".into(), unit: "px".into(), ..Series::default() });
    for two in frames.windows(2) {
        let ((_, from), (t_to, to)) = (&two[0], &two[1]);
        let errors_px = frame_errors_px(from, (*t_to, to), camera)?;
        if let Some(middle) = median(&errors_px) {
            series.t_s.push((t_to - start_ns) as f64 * 1e-9);
            series.values.push(middle);
        }
        all_px.extend(errors_px);
    }
    if all_px.is_empty() {
        metrics.note("No track was seen in two successive frames with true depth, so tracks are not judged.");
        return Ok(());
    }
    metrics.add("track_error_median", median(&all_px), "px");
    metrics.add("track_error_p95", percentile(&all_px, 0.95), "px");
    metrics.add("track_steps_judged", all_px.len() as f64, "1");
    metrics.series.push(series);
    Ok(())
}

fn frame_errors_px(
    from: &[&TrackedPixel],
    (t_to, to): (i64, &[&TrackedPixel]),
    camera: &TrueCamera,
) -> Result<Vec<f64>, EvaluationError> {
    let Some(first) = from.first() else { return Ok(vec![]) };
    let Some(depth) = camera.depth(first.t_ns)? else { return Ok(vec![]) };
    let seen_in_to: HashMap<u64, &TrackedPixel> = to.iter().map(|seen| (seen.track_id, *seen)).collect();
    let error = |seen: &&TrackedPixel| {
        let next = seen_in_to.get(&seen.track_id)?;
        let point = camera.surface_point(seen.t_ns, &seen.pixel_px, &depth)?;
        Some((camera.pixel_of(t_to, &point)? - next.pixel_px).norm())
    };
    Ok(from.iter().filter_map(error).collect())
}
