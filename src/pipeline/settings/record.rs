//! The resolved copy beside a result.

use crate::dataset::{DatasetError, write_text};
use crate::settings::{Settings, written};
use std::path::Path;

/// Writes `settings.toml` into a result folder: every setting of a command, as used.
pub(in crate::pipeline) fn write_settings(
    folder: &Path,
    command: &str,
    settings: &impl Settings,
) -> Result<(), DatasetError> {
    write_text(&folder.join("settings.toml"), &written(settings, command))
}
