//! The data set's folder: who may use it, and the journal of what is finished in it.

use super::record::FrameRecord;
use super::request::{FrameKey, SynthesizeRequest};
use crate::dataset::{
    Checksums, DatasetError, EarlierWork, Journal, read_earlier_work, remove_partial_files, sha256_hex,
    write_atomically, write_text,
};
use crate::pipeline::error::PipelineError;
use crate::scene::Scenario;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard};

/// A data set that is being made.
pub(super) struct DatasetFolder {
    pub root: PathBuf,
    state: Mutex<(Journal, Checksums)>,
}

impl DatasetFolder {
    /// Makes sure that the folder is new, or holds the same scenario drawn by the same adapter and the user asked to
    /// resume; returns what the earlier job said of its files.
    pub fn prepare(
        request: &SynthesizeRequest,
        scenario: &Scenario,
        adapter: &str,
    ) -> Result<EarlierWork, PipelineError> {
        let root = &request.out;
        let resolved = root.join("scenario.toml");
        let occupied = std::fs::read_dir(root).is_ok_and(|mut entries| entries.next().is_some());
        if occupied && !request.resume {
            return Err(PipelineError::NotEmpty { path: root.clone() });
        }
        if occupied {
            remove_partial_files(root)?;
        }
        if resolved.exists() && std::fs::read_to_string(&resolved).ok().as_deref() != Some(&scenario.to_toml()) {
            return Err(PipelineError::OtherScenario { path: root.clone() });
        }
        let earlier = read_earlier_work(root)?;
        let maker = Journal::maker(adapter);
        if let Some(found) = earlier.maker.as_ref().filter(|found| **found != maker) {
            return Err(PipelineError::OtherMaker { path: root.clone(), found: found.clone(), maker });
        }
        write_text(&resolved, &scenario.to_toml())?;
        Ok(earlier)
    }

    /// Begins the journal with the frames that are whole. A manifest of earlier work goes: it is written anew at the end.
    pub fn begin(
        root: &Path,
        adapter: &str,
        finished: &BTreeMap<FrameKey, FrameRecord>,
    ) -> Result<Self, PipelineError> {
        let checksums: Checksums = finished.values().flat_map(|record| record.checksums.clone()).collect();
        let journal = Journal::begin(root, adapter, &checksums)?;
        let manifest = root.join("manifest.json");
        if manifest.exists() {
            std::fs::remove_file(&manifest).map_err(DatasetError::io("remove", &manifest))?;
        }
        Ok(DatasetFolder { root: root.into(), state: Mutex::new((journal, checksums)) })
    }

    /// Writes the files of one frame whole, then notes their checksums in the journal.
    pub fn write(&self, files: &[(String, Vec<u8>)]) -> Result<Checksums, DatasetError> {
        let mut checksums = Checksums::new();
        for (name, bytes) in files {
            write_atomically(&self.root.join(name), |w| w.write_all(bytes))?;
            checksums.insert(name.clone(), sha256_hex(bytes));
        }
        self.note(&checksums)?;
        Ok(checksums)
    }

    /// Notes files that are whole.
    pub fn note(&self, finished: &Checksums) -> Result<(), DatasetError> {
        let mut state = self.lock();
        state.0.add(finished)?;
        state.1.extend(finished.clone());
        Ok(())
    }

    /// Writes the manifest with the checksums that are known, then removes the journal.
    pub fn finish(
        self,
        write_manifest: impl FnOnce(&Checksums) -> Result<(), DatasetError>,
    ) -> Result<(), PipelineError> {
        let (journal, known) = self.state.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner());
        write_manifest(&known)?;
        Ok(journal.remove()?)
    }

    fn lock(&self) -> MutexGuard<'_, (Journal, Checksums)> {
        self.state.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
    }
}
