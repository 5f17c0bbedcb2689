//! `opnav map`: a scenario to a map of its landing area.

use super::progress::Terminal;
use super::settings_arguments::SettingsArguments;
use opnav::pipeline::{MapRequest, PipelineError, SurveyLevel, make_map};
use std::path::PathBuf;

/// Make a map of a descent's landing area: orthoimages with heights, from fine to coarse.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Scenario file of a descent.
    scenario: PathBuf,
    /// Folder of the map.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    #[command(flatten)]
    settings: SettingsArguments,
    /// A square about the site, as metres a pixel and metres a side; may be repeated, from fine to coarse [default: those
    /// of the scenario, or else 0.5,1000 2,4000 8,20000].
    #[arg(long = "level", value_name = "M_PX,SIDE_M", value_parser = level)]
    levels: Vec<SurveyLevel>,
    /// Part of the name of the graphics adapter to use.
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
}

fn level(text: &str) -> Result<SurveyLevel, String> {
    let wrong = || format!("'{text}' is not of the form 0.5,1000 (metres a pixel, metres a side)");
    let (metres_per_px, side_m) = text.split_once(',').ok_or_else(wrong)?;
    let number = |field: &str| field.trim().parse::<f64>().map_err(|_| wrong());
    Ok(SurveyLevel { metres_per_px: number(metres_per_px)?, side_m: number(side_m)? })
}

/// Makes the map and says what it holds.
pub fn run(arguments: &Arguments, terminal: &Terminal) -> Result<(), PipelineError> {
    let request = MapRequest {
        scenario: arguments.scenario.clone(),
        out: arguments.out.clone(),
        layers: arguments.settings.layers([]),
        levels: arguments.levels.clone(),
        adapter: arguments.adapter.clone(),
    };
    let map = make_map(&request, terminal)?;
    for level in &map.levels {
        let (width, height) = level.size_px();
        terminal.say(&format!(
            "{width} x {height} px of {} m, 1σ {:.3} m across, {:.3} m in height",
            level.metres_per_px, level.sigma_horizontal_m, level.sigma_vertical_m
        ));
    }
    terminal.say(&format!("map in {}", arguments.out.display()));
    Ok(())
}
