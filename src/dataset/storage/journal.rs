//! Which files of an unfinished data set are whole: a list of SHA-256 that grows while the data set is made.
//!
//! Each line stands for one finished file. A line is written after its file has got its final name, in one piece; what a
//! killed job left of the last line is passed over. The manifest takes the journal's place when the data set is complete.

use super::checksums::{Checksums, JOURNAL};
use super::manifest::{Manifest, read_manifest};
use crate::dataset::error::DatasetError;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

/// The growing list of finished files.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    file: File,
}

impl Journal {
    /// Begins a journal anew with the files that are known to be whole, and says which adapter draws.
    ///
    /// # Errors
    /// [`DatasetError::Io`] with the path.
    pub fn begin(root: &Path, adapter: &str, finished: &Checksums) -> Result<Self, DatasetError> {
        let path = root.join(JOURNAL);
        let mut text = format!("# {}\n", Self::maker(adapter));
        finished.iter().for_each(|(name, sha256)| text += &line(name, sha256));
        super::atomic::write_text(&path, &text)?;
        let file = OpenOptions::new().append(true).open(&path).map_err(DatasetError::io("open", &path))?;
        Ok(Journal { path, file })
    }

    /// How this version of opnav with an adapter is named.
    pub fn maker(adapter: &str) -> String {
        maker(env!("CARGO_PKG_VERSION"), adapter)
    }

    /// Notes that files are whole.
    ///
    /// # Errors
    /// [`DatasetError::Io`] with the path.
    pub fn add(&mut self, finished: &Checksums) -> Result<(), DatasetError> {
        let text: String = finished.iter().map(|(name, sha256)| line(name, sha256)).collect();
        self.file.write_all(text.as_bytes()).map_err(DatasetError::io("write", &self.path))
    }

    /// Removes the journal, once the manifest is there.
    ///
    /// # Errors
    /// [`DatasetError::Io`] with the path.
    pub fn remove(self) -> Result<(), DatasetError> {
        std::fs::remove_file(&self.path).map_err(DatasetError::io("remove", &self.path))
    }
}

fn maker(version: &str, adapter: &str) -> String {
    format!("opnav {version}, {adapter}")
}

fn line(name: &str, sha256: &str) -> String {
    format!("{sha256}  {name}\n")
}

/// What an earlier job said of a data set's files, and the adapter that drew them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct EarlierWork {
    /// Version and adapter that made them, if known, as `opnav 0.1.0, llvmpipe`.
    pub maker: Option<String>,
    /// Checksums of the files that were whole.
    pub finished: Checksums,
}

/// Reads the journal of an unfinished data set, or the manifest of a finished one; nothing is known if there is neither.
///
/// # Errors
/// Names a file that cannot be read.
pub fn read_earlier_work(root: &Path) -> Result<EarlierWork, DatasetError> {
    let path = root.join(JOURNAL);
    if path.exists() {
        let bytes = std::fs::read(&path).map_err(DatasetError::io("read", &path))?;
        return Ok(parse(&String::from_utf8_lossy(&bytes)));
    }
    if !root.join("manifest.json").exists() {
        return Ok(EarlierWork::default());
    }
    let Manifest { opnav_version, adapter, sha256, .. } = read_manifest(root)?;
    Ok(EarlierWork { maker: Some(maker(&opnav_version, &adapter)), finished: sha256 })
}

fn parse(text: &str) -> EarlierWork {
    let mut work = EarlierWork::default();
    for line in text.split_inclusive('\n').filter_map(|line| line.strip_suffix('\n')) {
        if let Some(maker) = line.strip_prefix("# ") {
            work.maker = Some(maker.into());
        } else if let Some((sha256, name)) = line.split_once("  ").filter(|(sha256, _)| sha256.len() == 64) {
            work.finished.insert(name.into(), sha256.into());
        }
    }
    work
}
