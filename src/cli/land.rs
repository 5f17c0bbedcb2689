//! `opnav land`: navigate a descent.

use super::arguments::{put, word};
use super::input_arguments::FrontEndArguments;
use super::landing_options::LandingOptions;
use super::progress::Terminal;
use super::settings_arguments::SettingsArguments;
use opnav::pipeline::{LandRequest, LandSettings, PipelineError, Selector, land};
use std::path::PathBuf;

/// Navigate a descent by its images and its IMU.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// A data set with imu0/, designated.csv and initial_state.csv.
    folder: PathBuf,
    /// Folder of the result.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Folder of a map, as `opnav map` makes it: known points in every image, which make yaw observable.
    #[arg(long, value_name = "DIR")]
    map: Option<PathBuf>,
    /// How the unknown landmark is chosen [default: depth-error].
    #[arg(long, value_parser = word::<Selector>())]
    selector: Option<Selector>,
    /// How many unknown landmarks are followed at a time [default: 3].
    #[arg(long, value_name = "N")]
    landmarks: Option<usize>,
    /// Observations after which an unknown landmark may be replaced [default: 8].
    #[arg(long, value_name = "N")]
    reselect_after: Option<usize>,
    #[command(flatten)]
    filter: LandingOptions,
    #[command(flatten)]
    front_end: FrontEndArguments,
    /// Seed of the random selector [default: 0].
    #[arg(long)]
    seed: Option<u64>,
    #[command(flatten)]
    settings: SettingsArguments,
}

impl Arguments {
    fn settings(&self) -> Result<LandSettings, PipelineError> {
        let mut settings: LandSettings = self.settings.resolve()?;
        if self.map.is_some() {
            settings.input.map.clone_from(&self.map);
        }
        let landing = &mut settings.landing;
        self.filter.apply(landing);
        put(&mut landing.selector, self.selector);
        put(&mut landing.unknown_landmarks, self.landmarks);
        put(&mut landing.reselect_after, self.reselect_after);
        put(&mut landing.seed, self.seed);
        self.front_end.apply(&mut settings.front_end);
        Ok(settings)
    }
}

/// Navigates and prints the final state.
pub fn run(arguments: &Arguments, terminal: &Terminal) -> Result<(), PipelineError> {
    let request =
        LandRequest { folder: arguments.folder.clone(), out: arguments.out.clone(), settings: arguments.settings()? };
    let summary = land(&request, terminal)?;
    summary.notes.iter().for_each(|note| terminal.say(note));
    terminal.say(&format!("final state: {}", summary.last));
    terminal.say(&format!("result in {}", arguments.out.display()));
    Ok(())
}
