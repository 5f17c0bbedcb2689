//! Both missions end to end, small: render, track, navigate, evaluate, report.

use super::error::PipelineError;
use super::evaluate::evaluate_result;
use super::land::{LandRequest, land};
use super::page::write_page;
use super::progress::Progress;
use super::settings::{DemoSettings, TumbleSettings, write_settings};
use super::synthesize::{SynthesizeRequest, synthesize};
use super::track::{TrackRequest, track};
use super::tumble::{TumbleRequest, tumble};
use crate::dataset::write_text;
use crate::evaluation::Metrics;
use crate::navigation::tumbling::Estimator;
use crate::report::figure_lines;
use crate::settings::{Layers, Settings};
use std::path::{Path, PathBuf};
use std::time::Instant;
use toml::Table;

/// What the demonstration made.
#[derive(Debug, Clone)]
pub struct DemoOutcome {
    /// The HTML page.
    pub page: PathBuf,
    /// The main figures, a line each.
    pub lines: Vec<String>,
}

const DESCENT: &str = include_str!("../../datasets/mars_descent_small.toml");
const TUMBLING: &str = include_str!("../../datasets/tumbling_small.toml");

/// Runs the demonstration in `out`; frames that an earlier, interrupted run finished are kept.
///
/// # Errors
/// A setting out of range, or whatever stops one of the stories.
pub fn demonstrate(out: &Path, settings: &DemoSettings, progress: &dyn Progress) -> Result<DemoOutcome, PipelineError> {
    settings.validate()?;
    let start = Instant::now();
    let mut lines = Vec::new();
    progress.note("A descent to Mars: rendering 60 frames with truth, then navigating by them");
    let descent = make_images(out, "descent", (DESCENT, &settings.descent), progress)?;
    let landing = demonstrate_landing(out, &descent, settings, progress)?;
    let tracking = demonstrate_tracking(out, &descent, settings, progress)?;
    progress.note("A tumbling asteroid: rendering 60 frames with truth, then estimating its motion");
    let asteroid = make_images(out, "asteroid", (TUMBLING, &settings.asteroid), progress)?;
    let best = demonstrate_tumbling(&out.join("tumbling"), &asteroid, settings.tumble.clone(), progress)?;
    let mut by_paper = settings.tumble.clone();
    by_paper.tumbling.estimator = Estimator::Paper;
    let paper = demonstrate_tumbling(&out.join("tumbling-paper"), &asteroid, by_paper, progress)?;
    for (title, metrics) in
        [("Landing", &landing.1), ("Tracking", &tracking.1), ("Tumbling", &best.1), ("Tumbling, paper's EKF", &paper.1)]
    {
        lines.push(format!("\n{title}"));
        lines.extend(figure_lines(metrics));
    }
    write_settings(out, "demo", settings)?;
    let page = out.join("report.html");
    write_page(&[landing.0, tracking.0, best.0, paper.0], &page)?;
    lines.push(format!("\nDone in {:.0} s", start.elapsed().as_secs_f64()));
    Ok(DemoOutcome { page, lines })
}

fn make_images(
    out: &Path,
    name: &str,
    (scenario, over): (&str, &Table),
    progress: &dyn Progress,
) -> Result<PathBuf, PipelineError> {
    let file = out.join(format!("{name}.toml"));
    write_text(&file, scenario)?;
    let folder = out.join(name);
    let request = SynthesizeRequest {
        scenario: file,
        out: folder.clone(),
        layers: Layers::from(over),
        frames: None,
        resume: true,
        adapter: None,
    };
    synthesize(&request, progress)?;
    Ok(folder)
}

type Evaluated = (PathBuf, Metrics);

fn demonstrate_landing(
    out: &Path,
    images: &Path,
    settings: &DemoSettings,
    progress: &dyn Progress,
) -> Result<Evaluated, PipelineError> {
    let request = LandRequest { folder: images.into(), out: out.join("landing"), settings: settings.land.clone() };
    land(&request, progress)?;
    let metrics = evaluate_result(&request.out, images)?;
    Ok((request.out, metrics))
}

fn demonstrate_tracking(
    out: &Path,
    images: &Path,
    settings: &DemoSettings,
    progress: &dyn Progress,
) -> Result<Evaluated, PipelineError> {
    let request = TrackRequest { folder: images.into(), out: out.join("tracking"), settings: settings.track.clone() };
    track(&request, progress)?;
    let metrics = evaluate_result(&request.out, images)?;
    Ok((request.out, metrics))
}

fn demonstrate_tumbling(
    out: &Path,
    images: &Path,
    settings: TumbleSettings,
    progress: &dyn Progress,
) -> Result<Evaluated, PipelineError> {
    let request = TumbleRequest { folder: images.into(), out: out.into(), settings };
    tumble(&request, progress)?;
    let metrics = evaluate_result(&request.out, images)?;
    Ok((request.out, metrics))
}
