//! One image after it was drawn: through the detector, packed, hashed, written, noted.

use super::folder::DatasetFolder;
use super::record::{DrawnFrame, FrameRecord};
use crate::dataset::truth::{Landmark, TruthRaster};
use crate::dataset::{DatasetError, encode_grey_png, encode_scalar_tiff, encode_vector_tiff};
use crate::pipeline::error::PipelineError;
use crate::render::RenderedFrame;
use crate::scene::{DepthImage, SceneCamera, TruthConfig, observe_landmarks};
use image::{DynamicImage, GrayImage};
use std::path::Path;

/// The truth that an image comes with; depth is the first.
pub(super) fn truth_kinds(wanted: &TruthConfig) -> Vec<TruthRaster> {
    let on_request = [(wanted.normals, TruthRaster::Normals), (wanted.albedo, TruthRaster::Albedo)];
    let on_request = on_request.into_iter().filter_map(|(wanted, kind)| wanted.then_some(kind));
    [TruthRaster::Depth, TruthRaster::Mask].into_iter().chain(on_request).collect()
}

/// Names of an image's files: depth, the other truth, and last the image itself.
pub(super) fn frame_files(camera: &SceneCamera, t_ns: i64, wanted: &TruthConfig) -> Vec<String> {
    let truth = truth_kinds(wanted).into_iter().map(|kind| kind.file(&camera.id, t_ns));
    truth.chain([camera.id.image(t_ns)]).collect()
}

/// Exposes, packs and writes an image with its truth.
pub(super) fn finish_frame(
    frame: DrawnFrame,
    folder: &DatasetFolder,
    (landmarks, wanted): (&[Landmark], &TruthConfig),
) -> Result<FrameRecord, PipelineError> {
    let DrawnFrame { camera, detector, view, truth, .. } = frame;
    let depth = DepthImage { width_px: truth.width_px, depth_m: &truth.depth_m };
    let observations = observe_landmarks(landmarks, camera, &view, &depth);
    let image = detector.expose(&truth, view.t_ns).to_image().expect("a detector fills its picture");
    let mut files = Vec::new();
    for kind in truth_kinds(wanted) {
        let name = kind.file(&camera.id, view.t_ns);
        let bytes = pack_truth(kind, &truth, name.as_ref())?;
        files.push((name, bytes));
    }
    let name = camera.id.image(view.t_ns);
    let bytes = encode_grey_png(name.as_ref(), &image)?;
    files.push((name, bytes));
    Ok(FrameRecord { checksums: folder.write(&files)?, observations })
}

/// The content of one file of truth.
fn pack_truth(kind: TruthRaster, truth: &RenderedFrame, name: &Path) -> Result<Vec<u8>, DatasetError> {
    let size_px = (truth.width_px, truth.height_px);
    match kind {
        TruthRaster::Depth => encode_scalar_tiff(name, size_px, &truth.depth_m),
        TruthRaster::Mask => {
            let mask = GrayImage::from_raw(size_px.0, size_px.1, truth.mask.clone());
            encode_grey_png(name, &DynamicImage::ImageLuma8(mask.expect("a mask fills its picture")))
        }
        TruthRaster::Normals => {
            let normals: Vec<[f32; 3]> = surface(truth).map(|[x, y, z, _]| [x, y, z]).collect();
            encode_vector_tiff(name, size_px, &normals)
        }
        TruthRaster::Albedo => {
            let albedo: Vec<f32> = surface(truth).map(|[_, _, _, albedo]| albedo).collect();
            encode_scalar_tiff(name, size_px, &albedo)
        }
        TruthRaster::Flow => unreachable!("flow takes two pictures and is written after them"),
    }
}

/// Normal and albedo of each pixel, NaN where nothing is hit.
fn surface(truth: &RenderedFrame) -> impl Iterator<Item = [f32; 4]> {
    let values = truth.surface.as_ref().expect("the renderer was asked for normals and albedo");
    values.iter().zip(&truth.mask).map(
        |(value, mask)| {
            if mask & RenderedFrame::BODY == 0 { [f32::NAN; 4] } else { *value }
        },
    )
}
