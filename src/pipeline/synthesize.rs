//! Scenario to data set: build the scene, draw every frame with its truth, write the manifest last.

use super::track::checked_frames;
use super::{PipelineError, Progress};
use crate::dataset::truth::{LandmarkObservation, write_asteroid, write_lander_states, write_landmarks};
use crate::dataset::{
    CameraSensor, StampedPose, remove_partial_files, write_atomically, write_camera_sensor, write_depth_tiff,
    write_designated, write_grey_png, write_imu, write_imu_sensor, write_initial_state, write_manifest, write_text,
    write_tum,
};
use crate::render::{Gpu, RenderConfig, RenderedFrame, Renderer, World, expose};
use crate::scene::{Scenario, Scene, SensorConfig, View};
use image::GrayImage;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, sync_channel};

/// What to render, and where to.
#[derive(Debug, Clone)]
pub struct SynthesizeRequest {
    /// The scenario file.
    pub scenario: PathBuf,
    /// The data set's folder.
    pub out: PathBuf,
    /// `key=value` changes to the scenario, dotted keys.
    pub overrides: Vec<String>,
    /// Frames to make beside those that are there already; all if `None`.
    pub frames: Option<Range<usize>>,
    /// Continue an interrupted job.
    pub resume: bool,
    /// Part of the name of the graphics adapter to use.
    pub adapter: Option<String>,
}

/// Frames waiting to be written, so that drawing and writing overlap without holding many pictures.
const QUEUE_LENGTH: usize = 4;

/// Makes the data set; returns the number of frames in it.
///
/// # Errors
/// A bad scenario, no adapter, a folder in use, or a file that cannot be written. Finished frames stay and `resume`
/// continues after them.
pub fn synthesize(request: &SynthesizeRequest, progress: &dyn Progress) -> Result<usize, PipelineError> {
    let scenario = Scenario::read(&request.scenario, &request.overrides)?;
    let scene = scenario.build(request.scenario.parent().unwrap_or(Path::new(".")))?;
    let parts = SceneParts::of(&scene);
    let range = checked_frames(request.frames.clone(), parts.views.len())?;
    let wanted = |(index, view): &(usize, &View)| range.contains(index) || is_finished(&request.out, view);
    let views: Vec<View> = parts.views.iter().enumerate().filter(wanted).map(|(_, view)| *view).collect();
    let gpu = Gpu::new(request.adapter.as_deref())?;
    prepare_folder(request, &scenario)?;
    write_static_files(&request.out, &scene, &parts, &views)?;
    let mut renderer = Renderer::new(&gpu, parts.world, &parts.sensor.camera, &RenderConfig::default())?;
    progress.begin("rendering", views.len());
    render_and_write(&mut renderer, &parts, &views, (&request.out, scenario.seed, progress))?;
    progress.end();
    write_observations(&request.out, &scene, &parts, &views)?;
    write_manifest(&request.out, gpu.adapter_name(), views.len(), &["cam0"])?;
    Ok(views.len())
}

/// What both kinds of scene have in common.
struct SceneParts<'a> {
    world: World<'a>,
    views: &'a [View],
    sensor: &'a CameraSensor,
    sensor_model: &'a SensorConfig,
}

impl<'a> SceneParts<'a> {
    fn of(scene: &'a Scene) -> Self {
        match scene {
            Scene::Descent(s) => SceneParts {
                world: World::Terrain(&s.terrain),
                views: &s.views,
                sensor: &s.sensor,
                sensor_model: &s.sensor_model,
            },
            Scene::Tumbling(s) => SceneParts {
                world: World::Body(&s.body),
                views: &s.views,
                sensor: &s.sensor,
                sensor_model: &s.sensor_model,
            },
        }
    }
}

/// Makes sure that the folder is new, or holds the same scenario and the user asked to resume.
fn prepare_folder(request: &SynthesizeRequest, scenario: &Scenario) -> Result<(), PipelineError> {
    let resolved = request.out.join("scenario.toml");
    let occupied = std::fs::read_dir(&request.out).is_ok_and(|mut entries| entries.next().is_some());
    if occupied && !request.resume {
        return Err(PipelineError::NotEmpty { path: request.out.clone() });
    }
    if occupied {
        remove_partial_files(&request.out)?;
    }
    if resolved.exists() && std::fs::read_to_string(&resolved).ok().as_deref() != Some(&scenario.to_toml()) {
        return Err(PipelineError::OtherScenario { path: request.out.clone() });
    }
    Ok(write_text(&resolved, &scenario.to_toml())?)
}

/// Everything that is known before a picture is taken.
fn write_static_files(out: &Path, scene: &Scene, parts: &SceneParts, views: &[View]) -> Result<(), PipelineError> {
    write_camera_sensor(&out.join("cam0/sensor.yaml"), parts.sensor)?;
    write_atomically(&out.join("cam0/data.csv"), |w| {
        writeln!(w, "#timestamp [ns],filename")?;
        views.iter().try_for_each(|view| writeln!(w, "{0},{0}.png", view.t_ns))
    })?;
    let pose = |view: &View| StampedPose { t_ns: view.t_ns, reference_from_moving: view.reference_from_camera };
    write_tum(&out.join("truth/cam0.tum"), &views.iter().map(pose).collect::<Vec<_>>())?;
    match scene {
        Scene::Descent(s) => {
            write_imu(out, &s.imu)?;
            write_imu_sensor(out, &s.imu_noise)?;
            write_initial_state(out, &s.initial)?;
            write_designated(out, &s.designated)?;
            write_lander_states(out, &s.lander_states)?;
        }
        Scene::Tumbling(s) => write_asteroid(out, &s.states, &s.inertia)?,
    }
    Ok(())
}

struct FinishedFrame {
    t_ns: i64,
    picture: GrayImage,
    truth: RenderedFrame,
}

fn frame_paths(out: &Path, t_ns: i64) -> [PathBuf; 3] {
    [
        out.join(format!("truth/depth/cam0/{t_ns}.tiff")),
        out.join(format!("truth/mask/cam0/{t_ns}.png")),
        out.join(format!("cam0/data/{t_ns}.png")),
    ]
}

/// Whether a picture and its truth are there; files appear whole or not at all.
fn is_finished(out: &Path, view: &View) -> bool {
    frame_paths(out, view.t_ns).iter().all(|path| path.exists())
}

/// Draws on this thread and writes on another; frames that are already whole are left alone.
fn render_and_write(
    renderer: &mut Renderer,
    parts: &SceneParts,
    views: &[View],
    (out, seed, progress): (&Path, u64, &dyn Progress),
) -> Result<(), PipelineError> {
    std::thread::scope(|scope| {
        let (sender, receiver) = sync_channel::<FinishedFrame>(QUEUE_LENGTH);
        let writer = scope.spawn(move || write_frames(out, receiver));
        let mut outcome = Ok(());
        for (done, view) in views.iter().enumerate() {
            if !is_finished(out, view) {
                let frame = renderer.render(view).map(|truth| {
                    let picture = expose(&truth, parts.sensor_model, seed, view.t_ns);
                    FinishedFrame { t_ns: view.t_ns, picture, truth }
                });
                match frame {
                    Ok(frame) => {
                        if sender.send(frame).is_err() {
                            break; // the writer failed and says why below
                        }
                    }
                    Err(error) => {
                        outcome = Err(PipelineError::from(error));
                        break;
                    }
                }
            }
            progress.advance_to(done + 1);
        }
        drop(sender);
        writer.join().expect("the writing thread does not panic")?;
        outcome
    })
}

fn write_frames(out: &Path, frames: Receiver<FinishedFrame>) -> Result<(), PipelineError> {
    for frame in frames {
        let FinishedFrame { t_ns, picture, truth } = frame;
        let [depth_path, mask_path, picture_path] = frame_paths(out, t_ns);
        write_depth_tiff(&depth_path, truth.width_px, truth.height_px, &truth.depth_m)?;
        let mask = GrayImage::from_raw(truth.width_px, truth.height_px, truth.mask).expect("a mask fills its picture");
        write_grey_png(&mask_path, &mask)?;
        write_grey_png(&picture_path, &picture)?;
    }
    Ok(())
}

/// Projects the surface landmarks into every frame; visible where the drawn depth agrees.
fn write_observations(out: &Path, scene: &Scene, parts: &SceneParts, views: &[View]) -> Result<(), PipelineError> {
    let landmarks = match scene {
        Scene::Descent(s) => &s.landmarks,
        Scene::Tumbling(s) => &s.landmarks,
    };
    let camera = &parts.sensor.camera;
    let mut observations: Vec<LandmarkObservation> = Vec::new();
    for view in views {
        let depth = crate::dataset::read_depth_tiff(&frame_paths(out, view.t_ns)[0])?;
        observations.extend(landmarks.iter().filter_map(|landmark| {
            let point = view.reference_from_camera.inverse_transform_point(&landmark.position_m.into());
            let pixel_px = camera.project(&point.coords).filter(|pixel| camera.contains(pixel, 0.0))?;
            let visible = depth_agrees(&depth, &pixel_px, point.z);
            Some(LandmarkObservation { t_ns: view.t_ns, camera: 0, id: landmark.id, pixel_px, visible })
        }));
    }
    Ok(write_landmarks(out, landmarks, &observations)?)
}

/// Relative agreement of depths under which a landmark counts as not hidden.
const VISIBLE_DEPTH_TOLERANCE: f64 = 0.01;

fn depth_agrees(
    depth: &image::ImageBuffer<image::Luma<f32>, Vec<f32>>,
    pixel_px: &nalgebra::Vector2<f64>,
    depth_m: f64,
) -> bool {
    let (u, v) = (pixel_px.x.round().max(0.0) as u32, pixel_px.y.round().max(0.0) as u32);
    let drawn = depth.get_pixel_checked(u, v).map_or(f64::NAN, |pixel| f64::from(pixel.0[0]));
    (drawn - depth_m).abs() <= VISIBLE_DEPTH_TOLERANCE * depth_m
}
