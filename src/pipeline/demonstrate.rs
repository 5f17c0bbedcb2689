//! Both missions end to end, small: render, track, navigate, evaluate, report.

use super::error::PipelineError;
use super::evaluate::evaluate_result;
use super::land::{LandRequest, land};
use super::page::write_page;
use super::progress::Progress;
use super::synthesize::{SynthesizeRequest, synthesize};
use super::track::{TrackRequest, track};
use super::tumble::{TumbleRequest, tumble};
use crate::dataset::{CameraSource, FrameTimes, write_text};
use crate::evaluation::Metrics;
use crate::navigation::landing::LandingConfig;
use crate::navigation::tumbling::{Estimator, TumblingConfig};
use crate::report::figure_lines;
use crate::vision::{FrontEndConfig, FrontEndMode};
use std::path::{Path, PathBuf};
use std::time::Instant;

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
/// Whatever stops one of the stories.
pub fn demonstrate(out: &Path, progress: &dyn Progress) -> Result<DemoOutcome, PipelineError> {
    let start = Instant::now();
    let mut lines = Vec::new();
    progress.note("A descent to Mars: rendering 60 frames with truth, then navigating by them");
    let descent = make_images(out, "descent", DESCENT, progress)?;
    let landing = demonstrate_landing(out, &descent, progress)?;
    let tracking = demonstrate_tracking(out, &descent, progress)?;
    progress.note("A tumbling asteroid: rendering 60 frames with truth, then estimating its motion");
    let asteroid = make_images(out, "asteroid", TUMBLING, progress)?;
    let shooting = demonstrate_tumbling(out, &asteroid, (Estimator::Shooting, "tumbling"), progress)?;
    let paper = demonstrate_tumbling(out, &asteroid, (Estimator::Paper, "tumbling-paper"), progress)?;
    for (title, metrics) in [
        ("Landing", &landing.1),
        ("Tracking", &tracking.1),
        ("Tumbling", &shooting.1),
        ("Tumbling, paper's EKF", &paper.1),
    ] {
        lines.push(format!("\n{title}"));
        lines.extend(figure_lines(metrics));
    }
    let page = out.join("report.html");
    write_page(&[landing.0, tracking.0, shooting.0, paper.0], &page)?;
    lines.push(format!("\nDone in {:.0} s", start.elapsed().as_secs_f64()));
    Ok(DemoOutcome { page, lines })
}

fn make_images(out: &Path, name: &str, scenario: &str, progress: &dyn Progress) -> Result<PathBuf, PipelineError> {
    let file = out.join(format!("{name}.toml"));
    write_text(&file, scenario)?;
    let folder = out.join(name);
    let request = SynthesizeRequest {
        scenario: file,
        out: folder.clone(),
        overrides: Vec::new(),
        frames: None,
        resume: true,
        adapter: None,
    };
    synthesize(&request, progress)?;
    Ok(folder)
}

type Evaluated = (PathBuf, Metrics);

fn demonstrate_landing(out: &Path, images: &Path, progress: &dyn Progress) -> Result<Evaluated, PipelineError> {
    let request = LandRequest {
        map: None,
        folder: images.into(),
        out: out.join("landing"),
        config: LandingConfig::from_pixels(),
        front_end: FrontEndConfig::default(),
    };
    land(&request, progress)?;
    let metrics = evaluate_result(&request.out, images)?;
    Ok((request.out, metrics))
}

fn demonstrate_tracking(out: &Path, images: &Path, progress: &dyn Progress) -> Result<Evaluated, PipelineError> {
    let request = TrackRequest {
        folder: images.into(),
        out: out.join("tracking"),
        camera: CameraSource::Folder,
        times: FrameTimes::Folder,
        every: 1,
        frames: None,
        mask: None,
        config: FrontEndConfig::default(),
    };
    track(&request, progress)?;
    let metrics = evaluate_result(&request.out, images)?;
    Ok((request.out, metrics))
}

fn demonstrate_tumbling(
    out: &Path,
    images: &Path,
    (estimator, name): (Estimator, &str),
    progress: &dyn Progress,
) -> Result<Evaluated, PipelineError> {
    let request = TumbleRequest {
        folder: images.into(),
        out: out.join(name),
        camera: CameraSource::Folder,
        frames: None,
        config: TumblingConfig { estimator, ..TumblingConfig::default() },
        front_end: FrontEndConfig { mode: FrontEndMode::FixedCenter, ..FrontEndConfig::default() },
    };
    tumble(&request, progress)?;
    let metrics = evaluate_result(&request.out, images)?;
    Ok((request.out, metrics))
}
