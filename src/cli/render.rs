//! `opnav render`: a scenario to a data set.

use super::arguments::frame_range;
use super::progress::Terminal;
use opnav::pipeline::{PipelineError, SynthesizeRequest, synthesize};
use std::ops::Range;
use std::path::PathBuf;

/// Render a scenario into a data set with its truth.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Scenario file.
    scenario: PathBuf,
    /// Folder of the data set.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Seed of everything random; replaces the scenario's.
    #[arg(long)]
    seed: Option<u64>,
    /// Frames to render, counted from 0, without B.
    #[arg(long, value_name = "A..B", value_parser = frame_range)]
    frames: Option<Range<usize>>,
    /// Continue an interrupted data set.
    #[arg(long)]
    resume: bool,
    /// Change a key of the scenario, such as camera.width_px=512; may be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    overrides: Vec<String>,
    /// Part of the name of the graphics adapter to use.
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
}

/// Renders and says where.
pub fn run(arguments: &Arguments, terminal: &Terminal) -> Result<(), PipelineError> {
    let mut overrides = arguments.overrides.clone();
    overrides.extend(arguments.seed.map(|seed| format!("seed={seed}")));
    let request = SynthesizeRequest {
        scenario: arguments.scenario.clone(),
        out: arguments.out.clone(),
        overrides,
        frames: arguments.frames.clone(),
        resume: arguments.resume,
        adapter: arguments.adapter.clone(),
    };
    let frames = synthesize(&request, terminal)?;
    terminal.say(&format!("{frames} frames in {}", arguments.out.display()));
    Ok(())
}
