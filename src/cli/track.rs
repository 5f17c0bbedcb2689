//! `opnav track`: any folder of pictures to tracks and relative rotations.

use super::arguments::{CameraArguments, FrontEndArguments, frame_range, positive, positive_number};
use super::progress::Terminal;
use opnav::pipeline::{FrameTimes, FrontEndConfig, PipelineError, Progress, TrackRequest, track};
use std::ops::Range;
use std::path::PathBuf;

/// Track Harris features through a folder of pictures and recover the rotation of each pair.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// A data set, a EuRoC folder, or a folder of pictures.
    folder: PathBuf,
    /// Folder of the result.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    #[command(flatten)]
    camera: CameraArguments,
    /// List of `timestamp [ns],filename` for pictures whose names are no time stamps.
    #[arg(long, value_name = "LIST.CSV", conflicts_with = "rate_hz")]
    times: Option<PathBuf>,
    /// Pictures a second, in the order of their names.
    #[arg(long, value_name = "HZ", value_parser = positive_number)]
    rate_hz: Option<f64>,
    /// Take every N-th picture.
    #[arg(long, value_name = "N", default_value = "1", value_parser = positive)]
    every: usize,
    /// Pictures to take, counted from 0, without B.
    #[arg(long, value_name = "A..B", value_parser = frame_range)]
    frames: Option<Range<usize>>,
    /// Grey picture of 8 bits and the camera's size, 0 where not to look (parts of the spacecraft).
    #[arg(long, value_name = "FILE")]
    mask: Option<PathBuf>,
    #[command(flatten)]
    front_end: FrontEndArguments,
}

/// Tracks and prints the counts.
pub fn run(arguments: &Arguments, terminal: &Terminal) -> Result<(), PipelineError> {
    let request = TrackRequest {
        folder: arguments.folder.clone(),
        out: arguments.out.clone(),
        camera: arguments.camera.source(),
        times: match (&arguments.times, arguments.rate_hz) {
            (Some(path), _) => FrameTimes::List(path.clone()),
            (None, Some(rate_hz)) => FrameTimes::RateHz(rate_hz),
            (None, None) => FrameTimes::Folder,
        },
        every: arguments.every,
        frames: arguments.frames.clone(),
        mask: arguments.mask.clone(),
        config: arguments.front_end.applied_to(FrontEndConfig::default()),
    };
    let summary = track(&request, terminal)?;
    summary.notes.iter().for_each(|note| terminal.note(note));
    let count = |name: &str| summary.counts.get(name).copied().unwrap_or(0);
    terminal.say(&format!(
        "{} frames, {} of {} pairs accepted, result in {}",
        count("frames"),
        count("pairs_ok"),
        count("pairs"),
        arguments.out.display()
    ));
    Ok(())
}
