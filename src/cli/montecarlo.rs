//! `opnav montecarlo`: campaigns of simulated missions.

use super::arguments::{put, word};
use super::landing_options::LandingOptions;
use super::progress::Terminal;
use super::settings_arguments::SettingsArguments;
use clap::{Subcommand, ValueEnum};
use opnav::pipeline::{
    CampaignOptions, FieldOfView, MonteCarloRequest, MonteCarloSettings, PipelineError, Selector, montecarlo_landing,
};
use std::path::PathBuf;

/// Fly a mission many times with simulated measurements, and compare errors, envelopes and bounds.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(subcommand)]
    mission: Mission,
}

#[derive(Debug, Subcommand)]
enum Mission {
    Landing(Box<Landing>),
}

/// Land many times by simulated bearings: table.csv, epochs.csv, flights.csv, summary.json and report.html.
#[derive(Debug, clap::Args)]
struct Landing {
    /// Flights of each selector [default: 300].
    #[arg(long, value_name = "N")]
    runs: Option<u64>,
    /// Seed; flight k of a seed is the same whatever else is flown [default: 1].
    #[arg(long)]
    seed: Option<u64>,
    /// Folder of the result.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// How unknown landmarks are chosen; several are flown one after the other [default: depth-error].
    #[arg(long, value_parser = word::<Selector>(), value_delimiter = ',')]
    selector: Vec<Selector>,
    /// How many unknown landmarks are followed at a time [default: 1].
    #[arg(long, value_name = "N")]
    landmarks: Option<usize>,
    /// 1σ of a bearing in mrad [default: 1].
    #[arg(long, value_name = "MRAD")]
    sigma_bearing: Option<f64>,
    /// What the lander sees: every direction, a 90° camera, or a 60° camera turned 20° towards the site [default:
    /// everywhere].
    #[arg(long, value_parser = word::<FieldOfView>())]
    field_of_view: Option<FieldOfView>,
    /// The path: of fourth degree, or of fifth through the paper's initial attitude [default: quartic].
    #[arg(long, value_enum)]
    path: Option<PathName>,
    /// Share of bearings that are wrong, 0 to 0.5; with some, the filter's gate is set to 1 - 1e-5 unless settings say
    /// otherwise [default: 0].
    #[arg(long, value_name = "SHARE")]
    outliers: Option<f64>,
    /// Height of smooth relief in m; 0 draws each landmark's height by itself [default: 0].
    #[arg(long, value_name = "M")]
    relief: Option<f64>,
    #[command(flatten)]
    filter: LandingOptions,
    #[command(flatten)]
    settings: SettingsArguments,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum PathName {
    Quartic,
    Quintic,
}

impl Landing {
    fn settings(&self) -> Result<MonteCarloSettings, PipelineError> {
        let mut settings: MonteCarloSettings = self.settings.resolve()?;
        if !self.selector.is_empty() {
            settings.selectors.clone_from(&self.selector);
        }
        self.apply(&mut settings.campaign);
        Ok(settings)
    }

    fn apply(&self, options: &mut CampaignOptions) {
        put(&mut options.runs, self.runs);
        put(&mut options.seed, self.seed);
        put(&mut options.sigma_bearing_rad, self.sigma_bearing.map(|sigma_mrad| sigma_mrad * 1e-3));
        put(&mut options.outlier_share, self.outliers);
        put(&mut options.relief_m, self.relief);
        put(&mut options.field_of_view, self.field_of_view);
        put(&mut options.filter.unknown_landmarks, self.landmarks);
        self.filter.apply(&mut options.filter);
        match self.path {
            Some(PathName::Quartic) => options.guidance.profile = CampaignOptions::default().guidance.profile,
            Some(PathName::Quintic) => options.guidance.profile = CampaignOptions::papers_attitude().profile,
            None => {}
        }
        // The true planet is the one that the filter is told of.
        put(&mut options.guidance.gravity_m_s2, self.filter.gravity);
        put(&mut options.planet_rate_in_site_rad_s, self.filter.planet_rate_rad_s);
        let gate_confidence = CampaignOptions::default().filter.gate_confidence;
        if self.outliers.is_some_and(|share| share > 0.0) && options.filter.gate_confidence == gate_confidence {
            options.filter.gate_confidence = 1.0 - 1e-5;
        }
    }
}

/// Flies the campaigns and prints their table.
pub fn run(arguments: &Arguments, terminal: &Terminal) -> Result<(), PipelineError> {
    let Mission::Landing(landing) = &arguments.mission;
    let request = MonteCarloRequest { out: landing.out.clone(), settings: landing.settings()? };
    let outcome = montecarlo_landing(&request, terminal)?;
    terminal.say(&format!(
        "{:<20} {:>10} {:>12} {:>8} {:>10} {:>12} {:>8} {:>8} {:>7}",
        "3 r.m.s. at the end",
        "converged",
        "horizontal m",
        "z m",
        "(filter's)",
        "velocity m/s",
        "roll °",
        "pitch °",
        "NEES/9"
    ));
    for campaign in &outcome.campaigns {
        let e = campaign.final_errors();
        terminal.say(&format!(
            "{:<20} {:>10} {:>12.3} {:>8.2} {:>10.2} {:>12.3} {:>8.4} {:>8.4} {:>7.2}",
            campaign.options.filter.selector.word(),
            format!("{}/{}", e.converged, e.runs),
            e.horizontal_m,
            e.z_m,
            e.z_believed_m,
            e.velocity_m_s,
            e.roll_deg,
            e.pitch_deg,
            e.nees,
        ));
    }
    terminal.say(&format!("report in {}", landing.out.join("report.html").display()));
    Ok(())
}
