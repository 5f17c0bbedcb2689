//! `opnav tumble`: the motion of a tumbling body.

use super::arguments::{put, word};
use super::input_arguments::{FrontEndArguments, InputArguments};
use super::progress::Terminal;
use super::settings_arguments::SettingsArguments;
use opnav::pipeline::{Estimator, PipelineError, TumbleRequest, TumbleSettings, tumble};
use std::path::PathBuf;

/// Estimate attitude, rate and inertia ratios of a tumbling small body.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// A data set or a folder of images of one body, taken by a camera that does not turn.
    folder: PathBuf,
    /// Folder of the result.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    #[command(flatten)]
    input: InputArguments,
    /// The estimator [default: shooting].
    #[arg(long, value_parser = word::<Estimator>())]
    estimator: Option<Estimator>,
    #[command(flatten)]
    front_end: FrontEndArguments,
    #[command(flatten)]
    settings: SettingsArguments,
}

/// Estimates and prints the final state.
pub fn run(arguments: &Arguments, terminal: &Terminal) -> Result<(), PipelineError> {
    let mut settings: TumbleSettings = arguments.settings.resolve()?;
    arguments.input.apply(&mut settings.input);
    put(&mut settings.tumbling.estimator, arguments.estimator);
    arguments.front_end.apply(&mut settings.front_end);
    let request = TumbleRequest { folder: arguments.folder.clone(), out: arguments.out.clone(), settings };
    let summary = tumble(&request, terminal)?;
    summary.notes.iter().for_each(|note| terminal.say(note));
    terminal.say(&format!("final state: {}", summary.last));
    terminal.say(&format!("result in {}", arguments.out.display()));
    Ok(())
}
