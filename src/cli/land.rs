//! `opnav land`: navigate a descent.

use super::progress::Terminal;
use clap::ValueEnum;
use opnav::pipeline::{FilterKind, FrontEndConfig, LandRequest, LandingConfig, PipelineError, Selector, land};
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
    #[arg(long, value_enum, default_value = "depth-error")]
    selector: SelectorName,
    /// The filter: the consistent one, or the paper's standard error-state one.
    #[arg(long, value_enum, default_value = "hybrid")]
    filter: FilterName,
    /// How many unknown landmarks are followed at a time.
    #[arg(long, value_name = "N", default_value = "3")]
    landmarks: usize,
    /// Observations after which an unknown landmark may be replaced.
    #[arg(long, value_name = "N", default_value = "8")]
    reselect_after: usize,
    /// Gravity of the planet in m/s².
    #[arg(long, value_name = "M_S2", default_value = "3.711")]
    gravity: f64,
    /// Seed of the random selector.
    #[arg(long, default_value = "0")]
    seed: u64,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum SelectorName {
    DepthError,
    Svd,
    Gdop,
    Condition,
    Covariance,
    Random,
    None,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum FilterName {
    Hybrid,
    Standard,
}

impl From<SelectorName> for Selector {
    fn from(name: SelectorName) -> Self {
        match name {
            SelectorName::DepthError => Selector::DepthError,
            SelectorName::Svd => Selector::Svd,
            SelectorName::Gdop => Selector::Gdop,
            SelectorName::Condition => Selector::Condition,
            SelectorName::Covariance => Selector::Covariance,
            SelectorName::Random => Selector::Random,
            SelectorName::None => Selector::None,
        }
    }
}

impl From<FilterName> for FilterKind {
    fn from(name: FilterName) -> Self {
        match name {
            FilterName::Hybrid => FilterKind::Hybrid,
            FilterName::Standard => FilterKind::Standard,
        }
    }
}

/// Navigates and prints the final state.
pub fn run(arguments: &Arguments, terminal: &Terminal) -> Result<(), PipelineError> {
    let config = LandingConfig {
        selector: arguments.selector.into(),
        filter: arguments.filter.into(),
        unknown_landmarks: arguments.landmarks,
        reselect_after: arguments.reselect_after,
        gravity_m_s2: arguments.gravity,
        seed: arguments.seed,
        ..LandingConfig::from_pixels()
    };
    let request = LandRequest {
        folder: arguments.folder.clone(),
        out: arguments.out.clone(),
        map: arguments.map.clone(),
        config,
        front_end: FrontEndConfig::default(),
    };
    let summary = land(&request, terminal)?;
    summary.notes.iter().for_each(|note| terminal.say(note));
    terminal.say(&format!("final state: {}", summary.last));
    terminal.say(&format!("result in {}", arguments.out.display()));
    Ok(())
}
