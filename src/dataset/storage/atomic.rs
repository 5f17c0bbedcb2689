//! Files appear whole or not at all: written beside their destination, then renamed.

use crate::dataset::error::DatasetError;
use std::io::{BufWriter, Write};
use std::path::Path;

/// How the names of unfinished files begin.
const PARTIAL: &str = ".partial-";

/// Removes the unfinished files that a killed job left under `root`.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn remove_partial_files(root: &Path) -> Result<(), DatasetError> {
    for entry in std::fs::read_dir(root).map_err(DatasetError::io("list", root))? {
        let path = entry.map_err(DatasetError::io("list", root))?.path();
        if path.is_dir() {
            remove_partial_files(&path)?;
        } else if path.file_name().is_some_and(|name| name.to_string_lossy().starts_with(PARTIAL)) {
            std::fs::remove_file(&path).map_err(DatasetError::io("remove", &path))?;
        }
    }
    Ok(())
}

/// Writes a file through `fill`; on any error the destination keeps what it had. Missing parent folders are made.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_atomically(
    path: &Path,
    fill: impl FnOnce(&mut (dyn std::io::Write + '_)) -> std::io::Result<()>,
) -> Result<(), DatasetError> {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder).map_err(DatasetError::io("make the folder", folder))?;
    let mut file = tempfile::Builder::new()
        .prefix(PARTIAL)
        .tempfile_in(folder)
        .map_err(DatasetError::io("make a temporary file in", folder))?;
    let write = |file: &mut tempfile::NamedTempFile| -> std::io::Result<()> {
        let mut writer = BufWriter::new(file.as_file_mut());
        fill(&mut writer)?;
        writer.flush()
    };
    write(&mut file).map_err(DatasetError::io("write", path))?;
    make_readable(&file).map_err(DatasetError::io("write", path))?;
    file.persist(path).map_err(|e| DatasetError::io("write", path)(e.error))?;
    Ok(())
}

/// Writes a text file atomically.
///
/// # Errors
/// As [`write_atomically`].
pub fn write_text(path: &Path, text: &str) -> Result<(), DatasetError> {
    write_atomically(path, |w| w.write_all(text.as_bytes()))
}

/// Temporary files are private to their owner; finished ones are readable like any other.
#[cfg(unix)]
fn make_readable(file: &tempfile::NamedTempFile) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.as_file().set_permissions(std::fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn make_readable(_: &tempfile::NamedTempFile) -> std::io::Result<()> {
    Ok(())
}
