//! `opnav demo`: both missions end to end, small, then the report.

use super::progress::Terminal;
use super::settings_arguments::SettingsArguments;
use opnav::pipeline::{PipelineError, demonstrate};
use std::path::PathBuf;

/// Render, track, navigate and evaluate both missions, small, and write one page about it.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Folder of everything made.
    #[arg(long, value_name = "DIR", default_value = "out/demo")]
    out: PathBuf,
    #[command(flatten)]
    settings: SettingsArguments,
}

/// Runs the demonstration and says where the page is.
pub fn run(arguments: &Arguments, terminal: &Terminal) -> Result<(), PipelineError> {
    let outcome = demonstrate(&arguments.out, &arguments.settings.resolve()?, terminal)?;
    outcome.lines.iter().for_each(|line| terminal.say(line));
    terminal.say(&format!("\nThe page: {}", outcome.page.display()));
    Ok(())
}
