//! `opnav render`: a scenario to a data set.

use super::frame_range::frame_range;
use super::progress::Terminal;
use super::settings_arguments::SettingsArguments;
use opnav::pipeline::{PipelineError, SynthesizeRequest, Synthesized, synthesize};
use std::ops::Range;
use std::path::PathBuf;
use std::time::Duration;

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
    #[command(flatten)]
    settings: SettingsArguments,
    /// Part of the name of the graphics adapter to use.
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
}

/// Renders and says where.
pub fn run(arguments: &Arguments, terminal: &Terminal) -> Result<(), PipelineError> {
    let request = SynthesizeRequest {
        scenario: arguments.scenario.clone(),
        out: arguments.out.clone(),
        layers: arguments.settings.layers(arguments.seed.map(|seed| format!("seed={seed}"))),
        frames: arguments.frames.clone(),
        resume: arguments.resume,
        adapter: arguments.adapter.clone(),
    };
    let Synthesized { frames, cameras, timing } = synthesize(&request, terminal)?;
    let of_each = if cameras > 1 { format!(" of each of {cameras} cameras") } else { String::new() };
    terminal.say(&format!("{frames} frames{of_each} in {}", arguments.out.display()));
    if timing.drawn > 0 {
        let each_ms = |time: Duration| time.as_secs_f64() * 1e3 / timing.drawn as f64;
        let [wall, drawing, finishing] = [timing.wall, timing.drawing, timing.finishing].map(each_ms);
        terminal.say(&format!(
            "{} drawn, {wall:.0} ms a frame: {drawing:.0} ms to draw, and beside it {finishing:.0} ms to expose, pack and write",
            timing.drawn
        ));
    }
    Ok(())
}
