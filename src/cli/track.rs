//! `opnav track`: any folder of images to tracks and relative rotations.

use super::input_arguments::{FrontEndArguments, InputArguments};
use super::progress::Terminal;
use super::settings_arguments::SettingsArguments;
use opnav::pipeline::{PipelineError, Progress, TrackRequest, TrackSettings, track};
use std::path::PathBuf;

/// Track Harris features through a folder of images and recover the rotation of each pair.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// A data set, a EuRoC folder, or a folder of images.
    folder: PathBuf,
    /// Folder of the result.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    #[command(flatten)]
    input: InputArguments,
    #[command(flatten)]
    front_end: FrontEndArguments,
    #[command(flatten)]
    settings: SettingsArguments,
}

/// Tracks and prints the counts.
pub fn run(arguments: &Arguments, terminal: &Terminal) -> Result<(), PipelineError> {
    let mut settings: TrackSettings = arguments.settings.resolve()?;
    arguments.input.apply(&mut settings.input);
    arguments.front_end.apply(&mut settings.front_end);
    let request = TrackRequest { folder: arguments.folder.clone(), out: arguments.out.clone(), settings };
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
