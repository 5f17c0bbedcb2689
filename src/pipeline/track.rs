//! Any folder of images to tracks and relative rotations.

use super::error::PipelineError;
use super::frame_range::checked_frames;
use super::front_end_files::{write_front_end, write_images};
use super::mask::read_mask;
use super::progress::Progress;
use super::settings::{InputSettings, TrackSettings, write_settings};
use super::summary::{Summary, UnusedFrame};
use crate::dataset::{Frame, ImageSequence};
use crate::observations::FrameStatus;
use crate::settings::Settings;
use crate::vision::{FrameReport, FrontEnd, FrontEndConfig, TrackInputs, track_sequence};
use image::GrayImage;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// What to track, and where the result goes.
#[derive(Debug, Clone)]
pub struct TrackRequest {
    /// A data set, a EuRoC folder or a folder of images.
    pub folder: PathBuf,
    /// The result's folder.
    pub out: PathBuf,
    /// Which images are taken, and how.
    pub settings: TrackSettings,
}

/// Tracks a sequence and writes tracks, rotations, the chains of attitudes, overlays and the summary. Images that cannot
/// be used are named in the summary, and tracking goes on around them.
///
/// # Errors
/// A setting out of range, fewer than two images that can be read, no camera, a mask that does not fit, or a file that
/// cannot be written.
pub fn track(request: &TrackRequest, progress: &dyn Progress) -> Result<Summary, PipelineError> {
    let TrackSettings { input, front_end: config } = &request.settings;
    request.settings.validate()?;
    let (sequence, mask) = open(&request.folder, input)?;
    let frames = checked_frames(input.frame_range(), sequence.frames.len())?;
    let inputs = TrackInputs { frames, every: input.every, mask: mask.as_ref(), ..TrackInputs::default() };
    let options = serde_json::json!({
        "folder": request.folder.display().to_string(),
        "every": input.every,
        "mask": input.mask.as_ref().map(|path| path.display().to_string()),
        "front_end": config,
    });
    let mut summary = Summary::new("tracking", options);
    let front_end = run_front_end(&sequence, config, &inputs, (progress, &mut summary))?;
    let start = Instant::now();
    let chains = write_front_end(&request.out, &front_end)?;
    summary.last = serde_json::json!({ "attitude_chains": chains });
    summary.timing_ms.insert("files".into(), start.elapsed().as_secs_f64() * 1e3);
    let start = Instant::now();
    write_images(&request.out, &sequence, &front_end)?;
    summary.timing_ms.insert("pictures".into(), start.elapsed().as_secs_f64() * 1e3);
    write_settings(&request.out, "track", &request.settings)?;
    summary.write(&request.out)?;
    Ok(summary)
}

/// The images of a folder, and the mask over them if there is one.
pub(super) fn open(folder: &Path, input: &InputSettings) -> Result<(ImageSequence, Option<GrayImage>), PipelineError> {
    let sequence = ImageSequence::open_timed(folder, &input.camera_source(), &input.frame_times())?;
    let mask = input.mask.as_deref().map(|path| read_mask(path, sequence.sensor.camera.size_px())).transpose()?;
    Ok((sequence, mask))
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
    let stages = front_end.stage_ms.iter().map(|(stage, ms)| (format!("front_end_{stage}"), *ms));
    summary.timing_ms.extend(stages.chain(mean_stage_ms(&front_end)));
    summary.t0_ns = front_end.frames.first().map(|f| f.t_ns);
    note_outcomes(sequence, &front_end, summary);
    Ok(front_end)
}

/// Counts frames and pairs by their outcome, and names the frames that could not be used.
fn note_outcomes(sequence: &ImageSequence, front_end: &FrontEnd, summary: &mut Summary) {
    let unused = front_end.frames.iter().filter(|f| f.status != FrameStatus::Ok);
    summary.frames_not_used = unused.map(|f| unused_frame(f, &sequence.frames[f.index])).collect();
    let count = |counts: &mut std::collections::BTreeMap<String, usize>, name: &str| {
        *counts.entry(name.replace('-', "_")).or_default() += 1;
    };
    let counts = &mut summary.counts;
    counts.insert("observations".into(), front_end.observations.len());
    counts.insert("pairs_ok".into(), 0);
    for frame in &front_end.frames {
        count(counts, "frames");
        count(counts, &format!("frames_{}", frame.status.word()));
    }
    for pair in &front_end.rotations {
        count(counts, "pairs");
        count(counts, &format!("pairs_{}", pair.status.word()));
    }
    summary.notes.extend(sequence.notes.iter().cloned());
    if let Some(first) = summary.frames_not_used.first() {
        let (number, problem) = (summary.frames_not_used.len(), unused_in_words(first));
        summary
            .notes
            .push(format!("{number} of {} frames could not be used; the first: {problem}", front_end.frames.len()));
    }
}

/// What the summary says of a frame that could not be used.
fn unused_frame(report: &FrameReport, frame: &Frame) -> UnusedFrame {
    UnusedFrame {
        index: report.index,
        t_ns: report.t_ns,
        file: frame.path.display().to_string(),
        status: report.status,
        problem: report.problem.clone(),
    }
}

fn unused_in_words(frame: &UnusedFrame) -> String {
    frame.problem.clone().unwrap_or_else(|| format!("{}: {}", frame.file, frame.status.word()))
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
