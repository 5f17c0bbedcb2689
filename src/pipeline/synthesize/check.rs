//! Which frames of an earlier job can be trusted.

use super::frame::frame_files;
use super::record::FrameRecord;
use super::request::FrameKey;
use crate::dataset::{Checksums, EarlierWork, read_depth_tiff, sha256_hex};
use crate::scene::{DepthImage, Scene, TruthConfig, observe_landmarks};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::path::Path;

/// The frames whose files are all there with the checksums that the earlier job noted. Whatever was cut short, changed or
/// never noted is left out, and is made anew.
pub(super) fn check_earlier_frames(
    root: &Path,
    scene: &Scene,
    (earlier, wanted): (&EarlierWork, &TruthConfig),
) -> BTreeMap<FrameKey, FrameRecord> {
    let keys: Vec<FrameKey> = (0..scene.cameras().len())
        .flat_map(|camera| (0..scene.cameras()[camera].views.len()).map(move |frame| (camera, frame)))
        .collect();
    keys.par_iter().filter_map(|key| Some((*key, checked_frame(root, scene, (earlier, wanted), *key)?))).collect()
}

fn checked_frame(
    root: &Path,
    scene: &Scene,
    (earlier, wanted): (&EarlierWork, &TruthConfig),
    key: FrameKey,
) -> Option<FrameRecord> {
    let camera = &scene.cameras()[key.0];
    let view = &camera.views[key.1];
    let files = frame_files(camera, view.t_ns, wanted);
    let mut checksums = Checksums::new();
    for name in &files {
        let noted = earlier.finished.get(name)?;
        let bytes = std::fs::read(root.join(name)).ok()?;
        if sha256_hex(&bytes) != *noted {
            return None;
        }
        checksums.insert(name.clone(), noted.clone());
    }
    let depth = read_depth_tiff(&root.join(&files[0])).ok()?;
    let image = DepthImage { width_px: depth.width(), depth_m: depth.as_raw() };
    Some(FrameRecord { checksums, observations: observe_landmarks(scene.landmarks(), camera, view, &image) })
}
