//! `opnav land`: navigate a descent.

use super::arguments::FrontEndArguments;
use super::landing_options::{LandingOptions, selector_parser};
use super::progress::Terminal;
use opnav::pipeline::{FrontEndConfig, LandRequest, LandingConfig, PipelineError, Selector, land};
use std::path::PathBuf;

/// Navigate a descent by its pictures and its IMU.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// A data set with imu0/, designated.csv and initial_state.csv.
    folder: PathBuf,
    /// Folder of the result.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Folder of a map, as `opnav map` makes it: known points in every picture, which make yaw observable.
    #[arg(long, value_name = "DIR")]
    map: Option<PathBuf>,
    /// How the unknown landmark is chosen.
    #[arg(long, value_parser = selector_parser(), default_value = "depth-error")]
    selector: Selector,
    /// How many unknown landmarks are followed at a time.
    #[arg(long, value_name = "N", default_value = "3")]
    landmarks: usize,
    /// Observations after which an unknown landmark may be replaced.
    #[arg(long, value_name = "N", default_value = "8")]
    reselect_after: usize,
    #[command(flatten)]
    filter: LandingOptions,
    #[command(flatten)]
    front_end: FrontEndArguments,
    /// Seed of the random selector.
    #[arg(long, default_value = "0")]
    seed: u64,
}

/// Navigates and prints the final state.
pub fn run(arguments: &Arguments, terminal: &Terminal) -> Result<(), PipelineError> {
    let config = LandingConfig {
        selector: arguments.selector,
        unknown_landmarks: arguments.landmarks,
        reselect_after: arguments.reselect_after,
        seed: arguments.seed,
        ..arguments.filter.applied_to(LandingConfig::from_pixels())
    };
    let request = LandRequest {
        folder: arguments.folder.clone(),
        out: arguments.out.clone(),
        map: arguments.map.clone(),
        config,
        front_end: arguments.front_end.applied_to(FrontEndConfig::default()),
    };
    let summary = land(&request, terminal)?;
    summary.notes.iter().for_each(|note| terminal.say(note));
    terminal.say(&format!("final state: {}", summary.last));
    terminal.say(&format!("result in {}", arguments.out.display()));
    Ok(())
}
