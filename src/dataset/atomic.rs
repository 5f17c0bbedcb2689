//! Files appear whole or not at all: written beside their destination, then renamed.

use super::DatasetError;
use std::io::{BufWriter, Write};
use std::path::Path;

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
        .prefix(".partial-")
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
