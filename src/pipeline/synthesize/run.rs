//! The story from beginning to end.

use super::check::check_earlier_frames;
use super::draw::draw_frames;
use super::flow::write_flows;
use super::folder::DatasetFolder;
use super::lists::{write_lists, write_observation_lists};
use super::measured::{note_filled_posts, write_elevation};
use super::record::FrameRecord;
use super::request::{FrameKey, SynthesizeRequest, Synthesized};
use crate::dataset::{CameraId, Manifest, write_manifest};
use crate::pipeline::error::PipelineError;
use crate::pipeline::frame_range::checked_frames;
use crate::pipeline::progress::Progress;
use crate::render::Gpu;
use crate::scene::{Scenario, Scene};
use std::collections::BTreeMap;
use std::path::Path;

/// Makes the data set.
///
/// # Errors
/// A bad scenario, no adapter, a folder in use, or a file that cannot be written. Finished frames stay and `resume`
/// continues after them.
pub fn synthesize(request: &SynthesizeRequest, progress: &dyn Progress) -> Result<Synthesized, PipelineError> {
    let scenario = Scenario::read_under(&request.scenario, &request.layers)?;
    let scene = scenario.build(request.scenario.parent().unwrap_or(Path::new(".")))?;
    let available = scene.cameras()[0].views.len();
    let range = checked_frames(request.frames.clone(), available)?;
    let gpu = Gpu::new(request.adapter.as_deref())?;
    let earlier = DatasetFolder::prepare(request, &scenario, gpu.adapter_name())?;
    let root = request.out.as_path();
    let mut finished = check_earlier_frames(root, &scene, (&earlier, &scenario.truth));
    let is_there = |index: &usize| range.contains(index) || any_image(root, &scene, *index);
    let frames: Vec<usize> = (0..available).filter(is_there).collect();
    let folder = DatasetFolder::begin(root, gpu.adapter_name(), &finished)?;
    write_lists(root, &scene, &frames)?;
    write_elevation(root, &scene)?;
    note_filled_posts(&scene, progress);
    let missing = missing_frames(&scene, &frames, &finished);
    let timing = draw_frames(&gpu, (&scene, &scenario), (&missing, &folder), (&mut finished, progress))?;
    write_observation_lists(root, &scene, &finished)?;
    if scenario.truth.flow {
        write_flows(&scene, &frames, &folder, (&earlier, progress))?;
    }
    let cameras: Vec<CameraId> = scene.cameras().iter().map(|camera| camera.id).collect();
    folder.finish(|known| write_manifest(root, Manifest::new(gpu.adapter_name(), frames.len(), &cameras), known))?;
    Ok(Synthesized { frames: frames.len(), cameras: cameras.len(), timing })
}

/// Whether an earlier job took any camera's image of this index.
fn any_image(root: &Path, scene: &Scene, index: usize) -> bool {
    scene.cameras().iter().any(|camera| root.join(camera.id.image(camera.views[index].t_ns)).exists())
}

/// The frames to draw, camera by camera.
fn missing_frames(scene: &Scene, frames: &[usize], finished: &BTreeMap<FrameKey, FrameRecord>) -> Vec<FrameKey> {
    (0..scene.cameras().len())
        .flat_map(|camera| frames.iter().map(move |frame| (camera, *frame)))
        .filter(|key| !finished.contains_key(key))
        .collect()
}
