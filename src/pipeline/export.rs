//! A data set in the formats of other tools.

use super::error::PipelineError;
use crate::dataset::truth::{LandmarkObservation, camera_poses_file, read_landmarks, read_observations};
use crate::dataset::{
    CameraId, ColmapImage, ColmapModel, ColmapPoint, StampedPose, find_cameras, read_camera_sensor, read_tum,
    write_atomically, write_colmap, write_tum,
};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A format of another tool.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExportFormat {
    /// COLMAP's text model: cameras, posed images, landmarks with their tracks.
    Colmap,
    /// The lists of the TUM RGB-D benchmark: `rgb.txt` and `groundtruth.txt` for each camera.
    Tum,
}

/// What to export.
#[derive(Debug, Clone)]
pub struct ExportRequest {
    /// The data set, with its truth.
    pub folder: PathBuf,
    /// Where the files go. They name images relative to the data set's folder.
    pub out: PathBuf,
    /// The format.
    pub format: ExportFormat,
}

/// Writes true poses, cameras and landmarks in another format; returns the number of images.
///
/// # Errors
/// Names the file of the data set that is missing or malformed, or the file that cannot be written.
pub fn export(request: &ExportRequest) -> Result<usize, PipelineError> {
    let cameras = find_cameras(&request.folder)?;
    match request.format {
        ExportFormat::Colmap => export_colmap(request, &cameras),
        ExportFormat::Tum => export_tum(request, &cameras),
    }
}

fn export_colmap(request: &ExportRequest, cameras: &[CameraId]) -> Result<usize, PipelineError> {
    let root = request.folder.as_path();
    let point = |l: &crate::dataset::truth::Landmark| ColmapPoint { id: number(l.id), position_m: l.position_m };
    let mut model = ColmapModel { points: read_landmarks(root)?.iter().map(point).collect(), ..ColmapModel::default() };
    for (place, camera) in cameras.iter().enumerate() {
        model.cameras.push(read_camera_sensor(&camera.folder(root).join("sensor.yaml"))?.camera);
        let seen = visible(&read_observations(root, camera.node)?, camera);
        for StampedPose { t_ns, reference_from_moving } in read_tum(&camera_poses_file(root, camera))? {
            model.images.push(ColmapImage {
                camera: place,
                name: camera.image(t_ns),
                reference_from_camera: reference_from_moving,
                observations: seen.get(&t_ns).cloned().unwrap_or_default(),
            });
        }
    }
    write_colmap(&request.out, &model)?;
    Ok(model.images.len())
}

/// COLMAP's number of a landmark, from 1.
fn number(landmark: u32) -> u64 {
    u64::from(landmark) + 1
}

type Observations = BTreeMap<i64, Vec<(nalgebra::Vector2<f64>, u64)>>;

/// What a camera sees of the landmarks, image by image.
fn visible(observations: &[LandmarkObservation], camera: &CameraId) -> Observations {
    let mut seen = Observations::new();
    for o in observations.iter().filter(|o| o.camera == camera.number && o.visible) {
        seen.entry(o.t_ns).or_default().push((o.pixel_px, number(o.id)));
    }
    seen
}

fn export_tum(request: &ExportRequest, cameras: &[CameraId]) -> Result<usize, PipelineError> {
    let mut count = 0;
    for camera in cameras {
        let poses = read_tum(&camera_poses_file(&request.folder, camera))?;
        let folder = camera.folder(&request.out);
        write_tum(&folder.join("groundtruth.txt"), &poses)?;
        write_images(&folder.join("rgb.txt"), camera, &poses)?;
        count += poses.len();
    }
    Ok(count)
}

fn write_images(path: &Path, camera: &CameraId, poses: &[StampedPose]) -> Result<(), PipelineError> {
    Ok(write_atomically(path, |w| {
        writeln!(w, "# timestamp filename")?;
        poses.iter().try_for_each(|pose| {
            let (s, ns) = (pose.t_ns.div_euclid(1_000_000_000), pose.t_ns.rem_euclid(1_000_000_000));
            writeln!(w, "{s}.{ns:09} {}", camera.image(pose.t_ns))
        })
    })?)
}
