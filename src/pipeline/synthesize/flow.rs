//! Optical flow from each image to the next, from the depths on disk.

use super::folder::DatasetFolder;
use crate::dataset::truth::{TruthRaster, encode_flow};
use crate::dataset::{Checksums, DatasetError, EarlierWork, read_depth_tiff, sha256_hex};
use crate::pipeline::error::PipelineError;
use crate::pipeline::progress::Progress;
use crate::scene::{DepthImage, Scene, SceneCamera, optical_flow};
use rayon::prelude::*;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Writes the flow of every image whose next one in the schedule is in the data set too.
pub(super) fn write_flows(
    scene: &Scene,
    frames: &[usize],
    folder: &DatasetFolder,
    (earlier, progress): (&EarlierWork, &dyn Progress),
) -> Result<(), PipelineError> {
    let firsts = frames.windows(2).filter(|pair| pair[1] == pair[0] + 1).map(|pair| pair[0]);
    let firsts: Vec<usize> = firsts.collect();
    let jobs: Vec<(&SceneCamera, usize)> =
        scene.cameras().iter().flat_map(|camera| firsts.iter().map(move |first| (camera, *first))).collect();
    let done = AtomicUsize::new(0);
    progress.begin("optical flow", jobs.len());
    let outcome = jobs.par_iter().try_for_each(|(camera, first)| {
        let name = TruthRaster::Flow.file(&camera.id, camera.views[*first].t_ns);
        match whole_already(&folder.root, &name, earlier) {
            Some(known) => folder.note(&known)?,
            None => {
                folder.write(&[(name, encode_flow(&flow(&folder.root, camera, *first)?))])?;
            }
        }
        progress.advance_to(done.fetch_add(1, Ordering::Relaxed) + 1);
        Ok(())
    });
    progress.end();
    outcome
}

fn whole_already(root: &Path, name: &str, earlier: &EarlierWork) -> Option<Checksums> {
    let noted = earlier.finished.get(name)?;
    let found = sha256_hex(&std::fs::read(root.join(name)).ok()?);
    (found == *noted).then(|| Checksums::from([(name.to_string(), found)]))
}

fn flow(root: &Path, camera: &SceneCamera, first: usize) -> Result<crate::dataset::truth::OpticalFlow, DatasetError> {
    let [view, next] = [first, first + 1].map(|index| &camera.views[index]);
    let [depth, next_depth] =
        [view, next].map(|v| read_depth_tiff(&root.join(TruthRaster::Depth.file(&camera.id, v.t_ns))));
    let (depth, next_depth) = (depth?, next_depth?);
    let image = |p: &'_ image::ImageBuffer<image::Luma<f32>, Vec<f32>>| p.width();
    let (width_px, next_width_px) = (image(&depth), image(&next_depth));
    Ok(optical_flow(
        &camera.sensor.camera,
        (view, &DepthImage { width_px, depth_m: depth.as_raw() }),
        (next, &DepthImage { width_px: next_width_px, depth_m: next_depth.as_raw() }),
    ))
}
