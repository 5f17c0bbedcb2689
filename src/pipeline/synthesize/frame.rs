//! One picture after it was drawn: through the detector, packed, hashed, written, noted.

use super::folder::DatasetFolder;
use crate::dataset::truth::Landmark;
use crate::dataset::truth::{LandmarkObservation, TruthRaster};
use crate::dataset::{Checksums, DatasetError, encode_grey_png, encode_scalar_tiff};
use crate::pipeline::PipelineError;
use crate::render::{Detector, RenderedFrame};
use crate::scene::{DepthPicture, SceneCamera, View, observe_landmarks};
use image::{DynamicImage, GrayImage};

/// A picture that was drawn.
pub(super) struct DrawnFrame<'a> {
    pub key: super::run::FrameKey,
    pub camera: &'a SceneCamera,
    pub detector: &'a Detector,
    pub view: View,
    pub truth: RenderedFrame,
}

/// What is known of a finished picture.
#[derive(Debug, Clone)]
pub(super) struct FrameRecord {
    /// Its files.
    pub checksums: Checksums,
    /// The landmarks within it.
    pub observations: Vec<LandmarkObservation>,
}

/// Names of a picture's files: depth, mask, and last the picture itself.
pub(super) fn frame_files(camera: &SceneCamera, t_ns: i64) -> [String; 3] {
    [TruthRaster::Depth.file(&camera.id, t_ns), TruthRaster::Mask.file(&camera.id, t_ns), camera.id.picture(t_ns)]
}

/// Exposes, packs and writes a picture with its truth.
pub(super) fn finish_frame(
    frame: DrawnFrame,
    folder: &DatasetFolder,
    landmarks: &[Landmark],
) -> Result<FrameRecord, PipelineError> {
    let DrawnFrame { camera, detector, view, truth, .. } = frame;
    let depth = DepthPicture { width_px: truth.width_px, depth_m: &truth.depth_m };
    let observations = observe_landmarks(landmarks, camera, &view, &depth);
    let picture = detector.expose(&truth, view.t_ns).to_image().expect("a detector fills its picture");
    let files = pack(camera, view.t_ns, truth, &picture)?;
    Ok(FrameRecord { checksums: folder.write(&files)?, observations })
}

fn pack(
    camera: &SceneCamera,
    t_ns: i64,
    truth: RenderedFrame,
    picture: &DynamicImage,
) -> Result<Vec<(String, Vec<u8>)>, DatasetError> {
    let size_px = (truth.width_px, truth.height_px);
    let [depth, mask, name] = frame_files(camera, t_ns);
    let mask_picture = GrayImage::from_raw(size_px.0, size_px.1, truth.mask).expect("a mask fills its picture");
    let depth_bytes = encode_scalar_tiff(depth.as_ref(), size_px, &truth.depth_m)?;
    let mask_bytes = encode_grey_png(mask.as_ref(), &DynamicImage::ImageLuma8(mask_picture))?;
    let picture_bytes = encode_grey_png(name.as_ref(), picture)?;
    Ok(vec![(depth, depth_bytes), (mask, mask_bytes), (name, picture_bytes)])
}
