//! `opnav montecarlo`: campaigns of simulated missions.

use super::landing_options::{LandingOptions, selector_parser};
use super::progress::Terminal;
use clap::{Subcommand, ValueEnum};
use opnav::pipeline::{CampaignOptions, FieldOfView};
use opnav::pipeline::{MonteCarloRequest, PipelineError, Selector, montecarlo_landing};
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
    /// Flights of each selector.
    #[arg(long, value_name = "N", default_value = "300")]
    runs: u64,
    /// Seed; flight k of a seed is the same whatever else is flown.
    #[arg(long, default_value = "1")]
    seed: u64,
    /// Folder of the result.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// How unknown landmarks are chosen; several are flown one after the other.
    #[arg(long, value_parser = selector_parser(), value_delimiter = ',', default_value = "depth-error")]
    selector: Vec<Selector>,
    /// How many unknown landmarks are followed at a time.
    #[arg(long, value_name = "N", default_value = "1")]
    landmarks: usize,
    /// 1σ of a bearing in mrad.
    #[arg(long, value_name = "MRAD", default_value = "1")]
    sigma_bearing: f64,
    /// What the lander sees: every direction, a 90° camera, or a 60° camera turned 20° towards the site.
    #[arg(long, value_enum, default_value = "everywhere")]
    field_of_view: FieldOfViewName,
    /// The path: of fourth degree, or of fifth through the paper's initial attitude.
    #[arg(long, value_enum, default_value = "quartic")]
    path: PathName,
    /// Share of bearings that are wrong, 0 to 0.5.
    #[arg(long, value_name = "SHARE", default_value = "0")]
    outliers: f64,
    /// Height of smooth relief in m; 0 draws each landmark's height by itself.
    #[arg(long, value_name = "M", default_value = "0")]
    relief: f64,
    #[command(flatten)]
    filter: LandingOptions,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum FieldOfViewName {
    Everywhere,
    Wide,
    Canted,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum PathName {
    Quartic,
    Quintic,
}

impl Landing {
    fn options(&self) -> CampaignOptions {
        let mut options = CampaignOptions {
            runs: self.runs,
            seed: self.seed,
            sigma_bearing_rad: self.sigma_bearing * 1e-3,
            outlier_share: self.outliers,
            relief_m: self.relief,
            field_of_view: match self.field_of_view {
                FieldOfViewName::Everywhere => FieldOfView::Everywhere,
                FieldOfViewName::Wide => FieldOfView::Wide,
                FieldOfViewName::Canted => FieldOfView::Canted,
            },
            ..CampaignOptions::default()
        };
        if matches!(self.path, PathName::Quintic) {
            options.guidance = CampaignOptions::papers_attitude();
        }
        options.filter = self.filter.applied_to(options.filter);
        options.filter.unknown_landmarks = self.landmarks;
        // The true planet is the one that the filter is told of.
        options.planet_rate_in_site_rad_s = options.filter.planet_rate_in_site_rad_s;
        options.guidance.gravity_m_s2 = options.filter.gravity_m_s2;
        if self.outliers > 0.0 {
            options.filter.gate_confidence = 1.0 - 1e-5;
        }
        options
    }
}

/// Flies the campaigns and prints their table.
pub fn run(arguments: &Arguments, terminal: &Terminal) -> Result<(), PipelineError> {
    let Mission::Landing(landing) = &arguments.mission;
    let request =
        MonteCarloRequest { out: landing.out.clone(), options: landing.options(), selectors: landing.selector.clone() };
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
