//! The files of a data set that are not images.

use super::record::FrameRecord;
use super::request::FrameKey;
use crate::dataset::truth::{
    LandmarkObservation, camera_poses_file, write_asteroid, write_lander_states, write_landmarks, write_node_states,
    write_observations,
};
use crate::dataset::{
    CameraId, StampedPose, write_atomically, write_camera_sensor, write_designated, write_imu, write_imu_sensor,
    write_initial_state, write_tum,
};
use crate::pipeline::error::PipelineError;
use crate::scene::{AttachmentScene, DescentScene, Scene, SceneCamera};
use std::collections::BTreeMap;
use std::path::Path;

/// Writes everything that is known before an image is taken; `frames` are the images that the data set holds.
pub(super) fn write_lists(root: &Path, scene: &Scene, frames: &[usize]) -> Result<(), PipelineError> {
    scene.cameras().iter().try_for_each(|camera| write_camera(root, camera, frames))?;
    write_landmarks(root, scene.landmarks())?;
    match scene {
        Scene::Descent(scene) => write_descent(root, scene),
        Scene::Tumbling(scene) => Ok(write_asteroid(root, &scene.states, &scene.inertia)?),
        Scene::Attachment(scene) => write_attachment(root, scene),
    }
}

fn write_camera(root: &Path, camera: &SceneCamera, frames: &[usize]) -> Result<(), PipelineError> {
    let folder = camera.id.folder(root);
    write_camera_sensor(&folder.join("sensor.yaml"), &camera.sensor)?;
    write_atomically(&folder.join("data.csv"), |w| {
        writeln!(w, "#timestamp [ns],filename")?;
        frames.iter().try_for_each(|frame| writeln!(w, "{0},{0}.png", camera.views[*frame].t_ns))
    })?;
    let pose = |frame: &usize| {
        let view = &camera.views[*frame];
        StampedPose { t_ns: view.t_ns, reference_from_moving: view.reference_from_camera }
    };
    Ok(write_tum(&camera_poses_file(root, &camera.id), &frames.iter().map(pose).collect::<Vec<_>>())?)
}

fn write_descent(root: &Path, scene: &DescentScene) -> Result<(), PipelineError> {
    write_imu(root, &scene.imu)?;
    write_imu_sensor(root, &scene.imu_noise)?;
    write_initial_state(root, &scene.initial)?;
    write_designated(root, &scene.designated)?;
    Ok(write_lander_states(root, &scene.lander_states)?)
}

fn write_attachment(root: &Path, scene: &AttachmentScene) -> Result<(), PipelineError> {
    for (number, node) in (0..).zip(&scene.nodes) {
        let folder = CameraId { node: Some(number), number: 0 }.spacecraft_folder(root);
        write_imu(&folder, &node.imu)?;
        write_imu_sensor(&folder, &scene.imu_noise)?;
        write_initial_state(&folder, &node.initial)?;
        write_node_states(root, Some(number), &node.states)?;
    }
    Ok(())
}

/// Writes where the landmarks fall, one list a spacecraft, sorted by time, camera and landmark.
pub(super) fn write_observation_lists(
    root: &Path,
    scene: &Scene,
    finished: &BTreeMap<FrameKey, FrameRecord>,
) -> Result<(), PipelineError> {
    let mut lists: BTreeMap<Option<u32>, Vec<LandmarkObservation>> = BTreeMap::new();
    for ((camera, _), record) in finished {
        lists.entry(scene.cameras()[*camera].id.node).or_default().extend(&record.observations);
    }
    for (node, mut observations) in lists {
        observations.sort_by_key(|o| (o.t_ns, o.camera, o.id));
        write_observations(root, node, &observations)?;
    }
    Ok(())
}
