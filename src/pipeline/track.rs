//! Any folder of pictures to tracks and relative rotations.

use super::{PipelineError, Progress, Summary};
use crate::dataset::{CameraSource, DatasetError, ImageSequence, StampedPose, write_atomically, write_tum};
use crate::vision::{
    FrameReport, FrontEnd, FrontEndConfig, PairStatus, TrackInputs, TrackObservation, draw_tracks, track_sequence,
    write_relative_rotations, write_tracks,
};
use image::RgbImage;
use nalgebra::{Isometry3, UnitQuaternion};
use std::io::Cursor;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// What to track, and where the result goes.
#[derive(Debug, Clone)]
pub struct TrackRequest {
    /// A data set, a EuRoC folder or a folder of pictures.
    pub folder: PathBuf,
    /// The result's folder.
    pub out: PathBuf,
    /// Where the camera's parameters come from.
    pub camera: CameraSource,
    /// Take every n-th picture.
    pub every: usize,
    /// Pictures to take; all if `None`.
    pub frames: Option<Range<usize>>,
    /// Front-end settings.
    pub config: FrontEndConfig,
}

/// Tracks a sequence and writes tracks, rotations, the chain of attitudes, overlays and the summary.
///
/// # Errors
/// Fewer than two pictures, an unreadable one, no camera, or a file that cannot be written.
pub fn track(request: &TrackRequest, progress: &dyn Progress) -> Result<Summary, PipelineError> {
    let sequence = ImageSequence::open(&request.folder, &request.camera)?;
    let frames = checked_frames(request.frames.clone(), sequence.frames.len())?;
    let inputs = TrackInputs { frames, every: request.every, rotation_prior: None, designated: None };
    let options = serde_json::json!({
        "folder": request.folder.display().to_string(),
        "every": request.every,
        "front_end": request.config,
    });
    let mut summary = Summary::new("tracking", options);
    let front_end = run_front_end(&sequence, &request.config, &inputs, (progress, &mut summary))?;
    write_front_end(&request.out, &front_end)?;
    write_overlays(&request.out, &sequence, &front_end)?;
    summary.write(&request.out)?;
    Ok(summary)
}

/// The frames asked for, or all; refused where they do not lie within those there are.
pub(super) fn checked_frames(frames: Option<Range<usize>>, available: usize) -> Result<Range<usize>, PipelineError> {
    let range = frames.unwrap_or(0..available);
    if range.start >= range.end || range.end > available {
        return Err(PipelineError::FrameRange { from: range.start, to: range.end, available });
    }
    Ok(range)
}

/// Runs the front end with progress, and notes counts and timing in the summary.
pub(super) fn run_front_end(
    sequence: &ImageSequence,
    config: &FrontEndConfig,
    inputs: &TrackInputs,
    (progress, summary): (&dyn Progress, &mut Summary),
) -> Result<FrontEnd, PipelineError> {
    let start = Instant::now();
    progress.begin("tracking", inputs.frames.len().div_ceil(inputs.every.max(1)));
    let front_end = track_sequence(sequence, config, inputs, &|done| progress.advance_to(done))?;
    progress.end();
    summary.timing_ms.insert("front_end".into(), start.elapsed().as_secs_f64() * 1e3);
    summary.timing_ms.extend(mean_stage_ms(&front_end));
    summary.t0_ns = front_end.frames.first().map(|f| f.t_ns);
    let accepted = front_end.rotations.iter().filter(|r| r.status == PairStatus::Ok).count();
    let counts = [
        ("frames", front_end.frames.len()),
        ("observations", front_end.observations.len()),
        ("pairs", front_end.rotations.len()),
        ("pairs_ok", accepted),
    ];
    summary.counts.extend(counts.map(|(name, count)| (name.to_string(), count)));
    Ok(front_end)
}

/// Mean time a frame of each stage of the front end, ms.
fn mean_stage_ms(front_end: &FrontEnd) -> Vec<(String, f64)> {
    let count = front_end.frames.len().max(1) as f64;
    let mean = |name: &str, of: fn(&FrameReport) -> f64| {
        (format!("{name}_per_frame"), front_end.frames.iter().map(of).sum::<f64>() / count)
    };
    vec![
        mean("load", |f| f.load_ms),
        mean("detect", |f| f.detect_ms),
        mean("describe", |f| f.describe_ms),
        mean("match", |f| f.match_ms),
        mean("rotation", |f| f.rotation_ms),
    ]
}

/// Writes `tracks.csv`, `relative_rotations.csv` and `attitude_chain.tum`.
pub(super) fn write_front_end(out: &Path, front_end: &FrontEnd) -> Result<(), PipelineError> {
    write_tracks(&out.join("tracks.csv"), &front_end.observations)?;
    write_relative_rotations(&out.join("relative_rotations.csv"), &front_end.rotations)?;
    Ok(write_tum(&out.join("attitude_chain.tum"), &attitude_chain(front_end))?)
}

/// Attitude of the camera in its own first axes, chained over consecutive pairs; ends at the first broken link.
fn attitude_chain(front_end: &FrontEnd) -> Vec<StampedPose> {
    let Some(first) = front_end.frames.first() else { return Vec::new() };
    let mut first_from_camera = UnitQuaternion::identity();
    let mut chain = vec![StampedPose { t_ns: first.t_ns, reference_from_moving: Isometry3::identity() }];
    for link in front_end.frames.windows(2) {
        let pair = front_end
            .rotations
            .iter()
            .find(|r| r.t_ns_from == link[0].t_ns && r.t_ns_to == link[1].t_ns && r.status == PairStatus::Ok);
        let Some(pair) = pair else { break };
        first_from_camera *= pair.camera_to_from_camera_from.inverse();
        let pose = Isometry3::from_parts(nalgebra::Translation3::identity(), first_from_camera);
        chain.push(StampedPose { t_ns: link[1].t_ns, reference_from_moving: pose });
    }
    chain
}

/// Number of frames that get an overlay picture.
const OVERLAYS: usize = 6;

/// Draws the tracks into a few frames spread over the sequence: `overlays/<t_ns>.png`.
pub(super) fn write_overlays(out: &Path, sequence: &ImageSequence, front_end: &FrontEnd) -> Result<(), PipelineError> {
    let frames = &front_end.frames;
    let last = frames.len().saturating_sub(1);
    let mut chosen: Vec<usize> = (0..OVERLAYS).map(|i| 1.max(i * last / (OVERLAYS - 1))).collect();
    chosen.dedup();
    for index in chosen.into_iter().filter(|i| *i < frames.len()) {
        let frame = &sequence.frames[frames[index].index];
        let now = observations_at(front_end, frames[index].t_ns);
        let before = observations_at(front_end, frames[index - 1].t_ns);
        let before_px = before.iter().map(|o| (o.track_id, o.pixel_px)).collect();
        let designated = now.iter().find(|o| o.track_id == TrackObservation::DESIGNATED);
        let overlay = draw_tracks(&sequence.load(frame)?, now, &before_px, designated);
        write_rgb_png(&out.join(format!("overlays/{}.png", frame.t_ns)), &overlay)?;
    }
    Ok(())
}

fn observations_at(front_end: &FrontEnd, t_ns: i64) -> &[TrackObservation] {
    let first = front_end.observations.partition_point(|o| o.t_ns < t_ns);
    let end = front_end.observations.partition_point(|o| o.t_ns <= t_ns);
    &front_end.observations[first..end]
}

fn write_rgb_png(path: &Path, picture: &RgbImage) -> Result<(), PipelineError> {
    let mut bytes = Cursor::new(Vec::new());
    picture
        .write_to(&mut bytes, image::ImageFormat::Png)
        .map_err(|e| DatasetError::Unusable { path: path.into(), problem: e.to_string() })?;
    Ok(write_atomically(path, |w| w.write_all(bytes.get_ref()))?)
}
