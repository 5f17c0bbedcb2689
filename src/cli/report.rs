//! `opnav report`: results to one page.

use super::progress::Terminal;
use opnav::pipeline::{PipelineError, write_page};
use std::path::PathBuf;

/// Write one self-contained HTML page about results.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Folders of results; evaluated ones show their errors.
    #[arg(required = true)]
    results: Vec<PathBuf>,
    /// The page.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
}

/// Writes the page.
pub fn run(arguments: &Arguments, terminal: &Terminal) -> Result<(), PipelineError> {
    write_page(&arguments.results, &arguments.out)?;
    terminal.say(&format!("page: {}", arguments.out.display()));
    Ok(())
}
