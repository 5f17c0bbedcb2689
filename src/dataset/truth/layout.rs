//! Where the ground truth of a camera lies.

use crate::dataset::camera_id::CameraId;
use std::path::{Path, PathBuf};

/// A kind of truth with a value for each pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TruthRaster {
    /// z-depth in m, float TIFF.
    Depth,
    /// Body, lit and terminator bits, PNG.
    Mask,
    /// Outward surface normal in reference axes, float TIFF of three channels.
    Normals,
    /// Albedo, float TIFF.
    Albedo,
    /// Motion to the next image in px, Middlebury `.flo`.
    Flow,
}

impl TruthRaster {
    fn folder_and_extension(self) -> (&'static str, &'static str) {
        match self {
            TruthRaster::Depth => ("depth", "tiff"),
            TruthRaster::Mask => ("mask", "png"),
            TruthRaster::Normals => ("normals", "tiff"),
            TruthRaster::Albedo => ("albedo", "tiff"),
            TruthRaster::Flow => ("flow", "flo"),
        }
    }

    /// Path of one image's file relative to the data set's root, such as `truth/depth/cam0/0.tiff` or
    /// `truth/node1/depth/cam0/0.tiff`.
    pub fn file(self, camera: &CameraId, t_ns: i64) -> String {
        let (folder, extension) = self.folder_and_extension();
        format!("{}{folder}/cam{}/{t_ns}.{extension}", prefix(camera.node), camera.number)
    }
}

fn prefix(node: Option<u32>) -> String {
    node.map_or_else(|| "truth/".into(), |node| format!("truth/node{node}/"))
}

/// The truth's folder of a spacecraft: `truth`, or `truth/node1` where there are several.
pub fn truth_folder(root: &Path, node: Option<u32>) -> PathBuf {
    root.join(prefix(node).trim_end_matches('/'))
}

/// The file of a camera's true poses in the reference frame, TUM format.
pub fn camera_poses_file(root: &Path, camera: &CameraId) -> PathBuf {
    truth_folder(root, camera.node).join(format!("cam{}.tum", camera.number))
}
