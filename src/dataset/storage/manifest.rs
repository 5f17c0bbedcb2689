//! The manifest: what a data set holds, written last.

use super::atomic::write_text;
use super::checksums::{Checksums, JOURNAL, sha256_hex};
use crate::dataset::camera_id::CameraId;
use crate::dataset::error::DatasetError;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Inventory of a finished data set.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Version of opnav that made it.
    pub opnav_version: String,
    /// Graphics adapter that drew it.
    pub adapter: String,
    /// Number of frames of each camera.
    pub frame_count: usize,
    /// Camera folders.
    pub cameras: Vec<String>,
    /// SHA-256 of every other file, by path relative to the root.
    pub sha256: Checksums,
}

impl Manifest {
    /// Manifest of this version of opnav that knows no file yet.
    pub fn new(adapter: &str, frame_count: usize, cameras: &[CameraId]) -> Self {
        Manifest {
            opnav_version: env!("CARGO_PKG_VERSION").into(),
            adapter: adapter.into(),
            frame_count,
            cameras: cameras.iter().map(CameraId::to_string).collect(),
            sha256: Checksums::new(),
        }
    }
}

/// Writes `manifest.json`: files under `root` whose checksum is in `known` are not read again, all others are.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_manifest(root: &Path, manifest: Manifest, known: &Checksums) -> Result<(), DatasetError> {
    let mut sha256 = Checksums::new();
    hash_folder(root, root, (known, &mut sha256))?;
    let manifest = Manifest { sha256, ..manifest };
    let text = serde_json::to_string_pretty(&manifest).expect("a manifest is plain data");
    write_text(&root.join("manifest.json"), &text)
}

/// Reads `manifest.json` under a data set's root.
///
/// # Errors
/// Names the file.
pub fn read_manifest(root: &Path) -> Result<Manifest, DatasetError> {
    let path = root.join("manifest.json");
    let text = super::table::read_text(&path)?;
    serde_json::from_str(&text).map_err(|e| DatasetError::Unusable { path, problem: e.to_string() })
}

fn hash_folder(root: &Path, folder: &Path, (known, sha256): (&Checksums, &mut Checksums)) -> Result<(), DatasetError> {
    for entry in std::fs::read_dir(folder).map_err(DatasetError::io("list", folder))? {
        let path = entry.map_err(DatasetError::io("list", folder))?.path();
        if path.is_dir() {
            hash_folder(root, &path, (known, &mut *sha256))?;
            continue;
        }
        let name = path.strip_prefix(root).expect("the path is under the root").to_string_lossy().replace('\\', "/");
        if name == "manifest.json" || name == JOURNAL {
            continue;
        }
        let digest = match known.get(&name) {
            Some(digest) => digest.clone(),
            None => sha256_hex(&std::fs::read(&path).map_err(DatasetError::io("read", &path))?),
        };
        sha256.insert(name, digest);
    }
    Ok(())
}
