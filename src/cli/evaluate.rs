//! `opnav evaluate`: a result against the truth.

use super::progress::Terminal;
use opnav::pipeline::{PipelineError, evaluate_result};
use opnav::report::figure_lines;
use std::path::PathBuf;

/// Hold a result against a data set's truth.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Folder of the result.
    result: PathBuf,
    /// Folder of the data set.
    #[arg(long, value_name = "FOLDER")]
    truth: PathBuf,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Evaluates, writes `metrics.json` into the result, prints the figures.
pub fn run(arguments: &Arguments, terminal: &Terminal) -> Result<(), PipelineError> {
    let metrics = evaluate_result(&arguments.result, &arguments.truth)?;
    if arguments.json {
        println!("{}", serde_json::to_string_pretty(&metrics).expect("metrics are plain data"));
    } else {
        figure_lines(&metrics).iter().for_each(|line| terminal.say(line));
    }
    Ok(())
}
