//! Which camera of a data set, and where its files lie.

use super::error::DatasetError;
use std::collections::BTreeSet;
use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// A camera of a data set: `cam0`, or `node1/cam0` where several spacecraft take images.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct CameraId {
    /// Number of the spacecraft, from 0; `None` where there is only one.
    pub node: Option<u32>,
    /// Number of the camera on its spacecraft, from 0.
    pub number: u32,
}

impl CameraId {
    /// A camera of the only spacecraft.
    pub fn single(number: u32) -> Self {
        CameraId { node: None, number }
    }

    /// The folder of images and `sensor.yaml` under a data set's root.
    pub fn folder(&self, root: &Path) -> PathBuf {
        root.join(self.to_string())
    }

    /// Path of an image relative to the data set's root, with `/`.
    pub fn image(&self, t_ns: i64) -> String {
        format!("{self}/data/{t_ns}.png")
    }

    /// The folder that holds what belongs to the camera's spacecraft: the root itself, or `node1` under it.
    pub fn spacecraft_folder(&self, root: &Path) -> PathBuf {
        self.node.map_or_else(|| root.into(), |node| root.join(format!("node{node}")))
    }
}

impl fmt::Display for CameraId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(node) = self.node {
            write!(f, "node{node}/")?;
        }
        write!(f, "cam{}", self.number)
    }
}

impl FromStr for CameraId {
    type Err = String;

    /// Reads what [`CameraId`] displays.
    fn from_str(text: &str) -> Result<Self, String> {
        let expected = || format!("'{text}' is not a camera's name such as cam0 or node1/cam0");
        let number = |part: &str, prefix: &str| part.strip_prefix(prefix).and_then(|digits| digits.parse::<u32>().ok());
        let (node, camera) = match text.split_once('/') {
            Some((node, camera)) => (Some(number(node, "node").ok_or_else(expected)?), camera),
            None => (None, text),
        };
        Ok(CameraId { node, number: number(camera, "cam").ok_or_else(expected)? })
    }
}

/// The cameras of a data set, spacecraft by spacecraft.
///
/// # Errors
/// [`DatasetError::Missing`] if the folder holds no camera.
pub fn find_cameras(root: &Path) -> Result<Vec<CameraId>, DatasetError> {
    let mut cameras = BTreeSet::new();
    for name in folder_names(root) {
        cameras.extend(name.parse::<CameraId>());
        if name.starts_with("node") {
            let inside = folder_names(&root.join(&name));
            cameras.extend(inside.iter().filter_map(|camera| format!("{name}/{camera}").parse::<CameraId>().ok()));
        }
    }
    if cameras.is_empty() {
        let cure = "give the folder of a data set that opnav render made".into();
        return Err(DatasetError::Missing { path: root.join("cam0"), cure });
    }
    Ok(cameras.into_iter().collect())
}

fn folder_names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    entries.filter(|e| e.path().is_dir()).map(|e| e.file_name().to_string_lossy().into_owned()).collect()
}
