//! How long a scenario's images take, stage by stage.

use super::error::PipelineError;
use super::frame_range::checked_frames;
use super::progress::Progress;
use crate::render::{Gpu, Renderer, StageTime};
use crate::scene::Scenario;
use crate::settings::Layers;
use crate::stats::upper_median;
use serde::Serialize;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// What to time.
#[derive(Debug, Clone)]
pub struct BenchRenderRequest {
    /// The scenario file.
    pub scenario: PathBuf,
    /// What is laid over the scenario.
    pub layers: Layers,
    /// Frames of the first camera to time; all if `None`.
    pub frames: Option<Range<usize>>,
    /// Part of the name of the graphics adapter to use.
    pub adapter: Option<String>,
}

/// Times of a scenario's images.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RenderTimes {
    /// Name of the adapter.
    pub adapter: String,
    /// Images timed, after one that is not.
    pub frames: usize,
    /// From the beginning to the first image in memory, s.
    pub first_frame_s: f64,
    /// Median time of each stage.
    pub stages: Vec<StageTime>,
    /// Images per second to memory, without waiting between stages.
    pub frames_per_s: f64,
}

/// Draws the images twice, once stage by stage and once without pause; nothing is written.
///
/// # Errors
/// A bad scenario, no adapter, or a view that cannot be an image.
pub fn bench_render(request: &BenchRenderRequest, progress: &dyn Progress) -> Result<RenderTimes, PipelineError> {
    let start = Instant::now();
    let scenario = Scenario::read_under(&request.scenario, &request.layers)?;
    let scene = scenario.build(request.scenario.parent().unwrap_or(Path::new(".")))?;
    let camera = &scene.cameras()[0];
    let views = &camera.views[checked_frames(request.frames.clone(), camera.views.len())?];
    let gpu = Gpu::new(request.adapter.as_deref())?;
    let world = super::synthesize::world(&scene);
    let mut renderer = Renderer::new(&gpu, world, &camera.sensor.camera, &scenario.render)?;
    renderer.render(&views[0])?;
    let first_frame_s = start.elapsed().as_secs_f64();
    progress.begin("timing", 2 * views.len());
    let mut by_frame = Vec::with_capacity(views.len());
    for (done, view) in views.iter().enumerate() {
        by_frame.push(renderer.render_timed(view)?.1);
        progress.advance_to(done + 1);
    }
    let begun = Instant::now();
    for (done, view) in views.iter().enumerate() {
        renderer.render(view)?;
        progress.advance_to(views.len() + done + 1);
    }
    let frames_per_s = views.len() as f64 / begun.elapsed().as_secs_f64();
    progress.end();
    let adapter = gpu.adapter_name().to_string();
    Ok(RenderTimes { adapter, frames: views.len(), first_frame_s, stages: medians(&by_frame), frames_per_s })
}

fn medians(by_frame: &[Vec<StageTime>]) -> Vec<StageTime> {
    let stage = |(index, first): (usize, &StageTime)| {
        let of = |value: fn(&StageTime) -> Option<f64>| {
            upper_median(&mut by_frame.iter().filter_map(|f| value(&f[index])).collect::<Vec<f64>>())
        };
        StageTime {
            stage: first.stage,
            cpu_ms: of(|s| Some(s.cpu_ms)).unwrap_or(f64::NAN),
            wall_ms: of(|s| Some(s.wall_ms)).unwrap_or(f64::NAN),
            gpu_ms: of(|s| s.gpu_ms),
        }
    };
    by_frame.first().map(|first| first.iter().enumerate().map(stage).collect()).unwrap_or_default()
}
