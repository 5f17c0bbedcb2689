//! Drawing the missing images, camera by camera.

use super::folder::DatasetFolder;
use super::frame::finish_frame;
use super::record::{DrawnFrame, FrameRecord};
use super::request::{DrawTiming, FrameKey};
use super::workers::draw_and_finish;
use crate::geometry::Camera;
use crate::pipeline::error::PipelineError;
use crate::pipeline::progress::Progress;
use crate::render::{Detector, Gpu, RenderedFrame, Renderer, World, add_stars};
use crate::scene::{RenderConfig, Scenario, Scene};
use std::collections::BTreeMap;
use std::time::{Duration, Instant};

/// Threads that finish images, at most: more would only hold more memory.
const MOST_THREADS: usize = 8;

/// Draws the missing frames and adds what is known of them to `finished`.
pub(super) fn draw_frames(
    gpu: &Gpu,
    (scene, scenario): (&Scene, &Scenario),
    (missing, folder): (&[FrameKey], &DatasetFolder),
    (finished, progress): (&mut BTreeMap<FrameKey, FrameRecord>, &dyn Progress),
) -> Result<DrawTiming, PipelineError> {
    let threads = std::thread::available_parallelism().map_or(1, usize::from).min(MOST_THREADS);
    let (start, mut drawing) = (Instant::now(), Duration::ZERO);
    let mut blank = BlankFrames::default();
    let detectors = detectors(scene, scenario.seed);
    let surface_truth = scenario.truth.normals || scenario.truth.albedo;
    let config = RenderConfig { surface_truth, ..scenario.render };
    progress.begin("rendering", missing.len());
    let finish = |frame: DrawnFrame| {
        let key = frame.key;
        finish_frame(frame, folder, (scene.landmarks(), &scenario.truth)).map(|record| (key, record))
    };
    let done = draw_and_finish(threads, finish, |pass_on| {
        let mut studio: Option<(Camera, Renderer)> = None;
        for (done, key) in missing.iter().enumerate() {
            let camera = &scene.cameras()[key.0];
            let view = camera.views[key.1];
            let begun = Instant::now();
            let renderer = renderer_for(&mut studio, (gpu, scene), &camera.sensor.camera, &config)?;
            let mut truth =
                renderer.expose(&camera.detector.shutter, view.t_ns, &|t_ns| scene.view_at(camera, t_ns))?;
            if let Some((sky, camera_from_inertial)) = scene.sky(camera) {
                add_stars(&mut truth, &camera.sensor.camera, sky, &camera_from_inertial);
            }
            drawing += begun.elapsed();
            blank.look_at(&truth, *key);
            if !pass_on(DrawnFrame { key: *key, camera, detector: &detectors[key.0], view, truth }) {
                break; // a thread failed and says why
            }
            progress.advance_to(done + 1);
        }
        Ok(())
    });
    progress.end();
    blank.warn(scene, progress);
    let done = done?;
    finished.extend(done.results);
    Ok(DrawTiming { drawn: missing.len(), wall: start.elapsed(), drawing, finishing: done.busy })
}

/// The detector of each camera.
fn detectors(scene: &Scene, seed: u64) -> Vec<Detector> {
    let cameras = (0..).zip(scene.cameras());
    cameras.map(|(number, c)| Detector::new(&c.sensor.camera, &c.detector, seed, number)).collect()
}

/// The renderer of a camera; the one before is given up where its camera is another, so that only one holds memory.
fn renderer_for<'a>(
    studio: &'a mut Option<(Camera, Renderer)>,
    (gpu, scene): (&Gpu, &Scene),
    camera: &Camera,
    config: &RenderConfig,
) -> Result<&'a mut Renderer, PipelineError> {
    if studio.as_ref().is_none_or(|(last, _)| last != camera) {
        *studio = None;
        *studio = Some((*camera, Renderer::new(gpu, world(scene), camera, config)?));
    }
    Ok(&mut studio.as_mut().expect("a renderer was just made").1)
}

/// What the renderer shows of a scene.
pub fn world(scene: &Scene) -> World<'_> {
    match scene {
        Scene::Descent(scene) => World::Terrain(&scene.terrain),
        Scene::Tumbling(scene) => World::Body(&scene.body),
        Scene::Attachment(scene) => World::Terrain(&scene.terrain),
    }
}

/// Images without anything to see in them. They are kept, for they may be meant, but never passed over in silence.
#[derive(Default)]
struct BlankFrames {
    without_surface: Vec<FrameKey>,
    without_light: Vec<FrameKey>,
}

impl BlankFrames {
    fn look_at(&mut self, frame: &RenderedFrame, key: FrameKey) {
        if frame.mask.iter().all(|mask| mask & RenderedFrame::BODY == 0) {
            self.without_surface.push(key);
        } else if frame.mask.iter().all(|mask| mask & RenderedFrame::LIT == 0) {
            self.without_light.push(key);
        }
    }

    fn warn(&self, scene: &Scene, progress: &dyn Progress) {
        let kinds = [
            (&self.without_surface, "show nothing of the surface: check where the camera looks"),
            (&self.without_light, "show no sunlit ground: check where the Sun stands"),
        ];
        for (keys, problem) in kinds {
            let Some((camera, frame)) = keys.first() else { continue };
            let camera = &scene.cameras()[*camera];
            let t_s = camera.views[*frame].t_ns as f64 * 1e-9;
            let count = keys.len();
            progress.note(&format!("warning: {count} pictures ({} at {t_s} s the first) {problem}", camera.id));
        }
    }
}
