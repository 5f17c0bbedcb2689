//! `opnav tumble`: the motion of a tumbling body.

use super::arguments::{CameraArguments, FrontEndArguments, frame_range};
use super::progress::Terminal;
use clap::ValueEnum;
use opnav::pipeline::{Estimator, FrontEndConfig, FrontEndMode, PipelineError, TumbleRequest, TumblingConfig, tumble};
use std::ops::Range;
use std::path::PathBuf;

/// Estimate attitude, rate and inertia ratios of a tumbling small body.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// A data set or a folder of pictures of one body, taken by a camera that does not turn.
    folder: PathBuf,
    /// Folder of the result.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    #[command(flatten)]
    camera: CameraArguments,
    /// Pictures to take, counted from 0, without B.
    #[arg(long, value_name = "A..B", value_parser = frame_range)]
    frames: Option<Range<usize>>,
    /// The estimator.
    #[arg(long, value_enum, default_value = "shooting")]
    estimator: EstimatorName,
    #[command(flatten)]
    front_end: FrontEndArguments,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum EstimatorName {
    /// The paper's extended Kalman filter, the baseline.
    Paper,
    /// A fit of the first minute, then a cloned Kalman filter.
    Realtime,
    /// Fit of the rotational dynamics to all pairs.
    Shooting,
}

impl From<EstimatorName> for Estimator {
    fn from(name: EstimatorName) -> Self {
        match name {
            EstimatorName::Paper => Estimator::Paper,
            EstimatorName::Realtime => Estimator::Realtime,
            EstimatorName::Shooting => Estimator::Shooting,
        }
    }
}

/// Estimates and prints the final state.
pub fn run(arguments: &Arguments, terminal: &Terminal) -> Result<(), PipelineError> {
    let request = TumbleRequest {
        folder: arguments.folder.clone(),
        out: arguments.out.clone(),
        camera: arguments.camera.source(),
        frames: arguments.frames.clone(),
        config: TumblingConfig { estimator: arguments.estimator.into(), ..TumblingConfig::default() },
        front_end: arguments
            .front_end
            .applied_to(FrontEndConfig { mode: FrontEndMode::FixedCenter, ..FrontEndConfig::default() }),
    };
    let summary = tumble(&request, terminal)?;
    summary.notes.iter().for_each(|note| terminal.say(note));
    terminal.say(&format!("final state: {}", summary.last));
    terminal.say(&format!("result in {}", arguments.out.display()));
    Ok(())
}
