//! `opnav bench`: how long the stages of a story take.

use super::frame_range::frame_range;
use super::progress::Terminal;
use super::settings_arguments::SettingsArguments;
use opnav::pipeline::{BenchRenderRequest, PipelineError, RenderTimes, bench_render};
use std::ops::Range;
use std::path::PathBuf;

/// Time the stages of a story.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(subcommand)]
    story: Story,
}

#[derive(Debug, clap::Subcommand)]
enum Story {
    Render(RenderArguments),
}

/// Time the drawing of a scenario's images; nothing is written.
#[derive(Debug, clap::Args)]
struct RenderArguments {
    /// Scenario file.
    scenario: PathBuf,
    /// Frames to time, counted from 0, without B.
    #[arg(long, value_name = "A..B", value_parser = frame_range)]
    frames: Option<Range<usize>>,
    #[command(flatten)]
    settings: SettingsArguments,
    /// Part of the name of the graphics adapter to use.
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Times and prints a table.
pub fn run(arguments: &Arguments, terminal: &Terminal) -> Result<(), PipelineError> {
    let Story::Render(arguments) = &arguments.story;
    let request = BenchRenderRequest {
        scenario: arguments.scenario.clone(),
        layers: arguments.settings.layers([]),
        frames: arguments.frames.clone(),
        adapter: arguments.adapter.clone(),
    };
    let times = bench_render(&request, terminal)?;
    if arguments.json {
        println!("{}", serde_json::to_string_pretty(&times).expect("times are plain data"));
    } else {
        print_table(&times);
    }
    Ok(())
}

fn print_table(times: &RenderTimes) {
    println!("{} frames on {}, median ms a frame", times.frames, times.adapter);
    println!("{:<18}{:>10}{:>10}{:>10}", "stage", "CPU", "wall", "GPU");
    for stage in &times.stages {
        let gpu = stage.gpu_ms.map_or("-".into(), |ms| format!("{ms:.1}"));
        println!("{:<18}{:>10.1}{:>10.1}{gpu:>10}", stage.stage, stage.cpu_ms, stage.wall_ms);
    }
    let sum = |value: fn(&opnav::pipeline::StageTime) -> f64| times.stages.iter().map(value).sum::<f64>();
    println!("{:<18}{:>10.1}{:>10.1}", "together", sum(|s| s.cpu_ms), sum(|s| s.wall_ms));
    println!("first frame after {:.2} s; {:.1} frames/s to memory", times.first_frame_s, times.frames_per_s);
}
