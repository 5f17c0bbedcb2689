//! A campaign of simulated landings: flown, tabled and drawn.

use super::error::PipelineError;
use super::progress::Progress;
use super::settings::{MonteCarloSettings, write_settings};
use super::summary::Summary;
use crate::campaign::{Campaign, run_campaign};
use crate::dataset::{DatasetError, write_text};
use crate::report::{Page, campaign_sections, write_report};
use crate::settings::Settings;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

/// What to fly, and where the result goes.
#[derive(Debug, Clone)]
pub struct MonteCarloRequest {
    /// The result's folder.
    pub out: PathBuf,
    /// What is flown.
    pub settings: MonteCarloSettings,
}

/// The campaigns of one request, in the order of its selectors.
#[derive(Debug)]
pub struct MonteCarloOutcome {
    /// The campaigns.
    pub campaigns: Vec<Campaign>,
    /// The summary as written.
    pub summary: Summary,
}

/// Flies one campaign a selector and writes `summary.json`, `table.csv`, `epochs.csv`, `flights.csv` and `report.html`.
///
/// # Errors
/// An option out of range, or a file that cannot be written.
pub fn montecarlo_landing(
    request: &MonteCarloRequest,
    progress: &(dyn Progress + Sync),
) -> Result<MonteCarloOutcome, PipelineError> {
    let MonteCarloSettings { selectors, campaign: shared } = &request.settings;
    request.settings.validate()?;
    let options = serde_json::to_value(shared).expect("options are plain data");
    let mut summary = Summary::new("landing-campaign", options);
    let mut campaigns = Vec::new();
    let selectors = if selectors.is_empty() { std::slice::from_ref(&shared.filter.selector) } else { selectors };
    for selector in selectors {
        let mut options = shared.clone();
        options.filter.selector = *selector;
        progress.begin(&format!("flying, {}", selector.word()), options.runs as usize);
        let (start, done) = (Instant::now(), AtomicUsize::new(0));
        let campaign = run_campaign(&options, &|| progress.advance_to(done.fetch_add(1, Ordering::Relaxed) + 1))?;
        progress.end();
        summary.timing_ms.insert(selector.word().into(), start.elapsed().as_secs_f64() * 1e3);
        summary.counts.insert(format!("converged_{}", selector.word()), campaign.converged());
        campaigns.push(campaign);
    }
    summary.counts.insert("flights".into(), shared.runs as usize);
    let last = campaigns.iter().map(|c| (c.options.filter.selector.word(), c.final_errors()));
    summary.last = last.map(|(word, e)| (word, serde_json::to_value(e).expect("plain data"))).collect();
    write_text(&request.out.join("table.csv"), &final_table(&campaigns))?;
    write_text(&request.out.join("epochs.csv"), &epoch_table(&campaigns))?;
    write_text(&request.out.join("flights.csv"), &flight_table(&campaigns))?;
    write_page(&request.out, &campaigns)?;
    write_settings(&request.out, "montecarlo landing", &request.settings)?;
    summary.write(&request.out)?;
    Ok(MonteCarloOutcome { campaigns, summary })
}

fn final_table(campaigns: &[Campaign]) -> String {
    let mut text = String::from(
        "#selector,flights,converged,horizontal_m,z_m,z_believed_m,velocity_m_s,roll_deg,pitch_deg,nees_per_dof\n",
    );
    for campaign in campaigns {
        let e = campaign.final_errors();
        let numbers = [e.horizontal_m, e.z_m, e.z_believed_m, e.velocity_m_s, e.roll_deg, e.pitch_deg, e.nees];
        let word = campaign.options.filter.selector.word();
        let numbers = numbers.map(|x| x.to_string()).join(",");
        writeln!(text, "{word},{},{},{numbers}", e.runs, e.converged).expect("text grows");
    }
    text
}

const COMPONENTS: [&str; 9] = ["x", "y", "z", "vx", "vy", "vz", "roll", "pitch", "yaw"];

/// A row a selector and second: r.m.s. error, 1σ by the filter and 1σ by the bound of each component, mean NEES / 9.
fn epoch_table(campaigns: &[Campaign]) -> String {
    let of = |kind: &str| COMPONENTS.map(|c| format!("{kind}_{c}")).join(",");
    let mut text = format!("#selector,t_s,{},{},{},nees_per_dof\n", of("rms_error"), of("sigma"), of("bound"));
    for campaign in campaigns {
        for second in 0..campaign.seconds() {
            let word = campaign.options.filter.selector.word();
            let mut row: Vec<String> = vec![word.into(), second.to_string()];
            row.extend((0..9).map(|c| campaign.rms(second, c).to_string()));
            row.extend((0..9).map(|c| campaign.believed(second, c).to_string()));
            row.extend((0..9).map(|c| campaign.bound(second, c).to_string()));
            row.push(campaign.nees(second).to_string());
            writeln!(text, "{}", row.join(",")).expect("text grows");
        }
    }
    text
}

/// A row a flight: its end.
fn flight_table(campaigns: &[Campaign]) -> String {
    let of = |kind: &str| COMPONENTS.map(|c| format!("{kind}_{c}")).join(",");
    let mut text = format!("#selector,flight,converged,gated,{},{}\n", of("error"), of("sigma"));
    for campaign in campaigns {
        for (number, flight) in campaign.flights.iter().enumerate() {
            let Some(end) = flight.epochs.last() else { continue };
            let word = campaign.options.filter.selector.word();
            let head = [word.into(), number.to_string(), flight.converged().to_string(), flight.gated.to_string()];
            let numbers = end.error.iter().chain(end.sigma.iter()).map(f64::to_string);
            let row: Vec<String> = head.into_iter().chain(numbers).collect();
            writeln!(text, "{}", row.join(",")).expect("text grows");
        }
    }
    text
}

fn write_page(out: &Path, campaigns: &[Campaign]) -> Result<(), PipelineError> {
    let page = Page {
        title: "opnav: a campaign of simulated landings".into(),
        lead: "Errors of the landing filter over many flights, beside its own envelope and the posterior Cramér–Rao \
               bound."
            .into(),
        sections: campaign_sections(campaigns)?,
    };
    std::fs::create_dir_all(out).map_err(DatasetError::io("create", out))?;
    Ok(write_report(&page, &out.join("report.html"))?)
}
