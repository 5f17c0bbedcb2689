//! The manifest: what a data set holds, written last.

use super::{DatasetError, write_text};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
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
    pub sha256: BTreeMap<String, String>,
}

/// Hashes every file under `root` and writes `manifest.json`.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_manifest(root: &Path, adapter: &str, frame_count: usize, cameras: &[&str]) -> Result<(), DatasetError> {
    let mut sha256 = BTreeMap::new();
    hash_folder(root, root, &mut sha256)?;
    let manifest = Manifest {
        opnav_version: env!("CARGO_PKG_VERSION").into(),
        adapter: adapter.into(),
        frame_count,
        cameras: cameras.iter().map(|s| s.to_string()).collect(),
        sha256,
    };
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

fn hash_folder(root: &Path, folder: &Path, sha256: &mut BTreeMap<String, String>) -> Result<(), DatasetError> {
    for entry in std::fs::read_dir(folder).map_err(DatasetError::io("list", folder))? {
        let path = entry.map_err(DatasetError::io("list", folder))?.path();
        if path.is_dir() {
            hash_folder(root, &path, sha256)?;
            continue;
        }
        let name = path.strip_prefix(root).expect("the path is under the root").to_string_lossy().replace('\\', "/");
        if name == "manifest.json" {
            continue;
        }
        let bytes = std::fs::read(&path).map_err(DatasetError::io("read", &path))?;
        let digest = Sha256::digest(&bytes);
        sha256.insert(name, digest.iter().map(|b| format!("{b:02x}")).collect());
    }
    Ok(())
}
