//! `--config` and `--set`: settings of a command from a file and one by one.

use opnav::settings::Layers;
#[cfg(any(feature = "vision", all(feature = "scene", feature = "report")))]
use opnav::settings::{Settings, SettingsError};
use std::path::PathBuf;

/// Settings from a file and one by one. Defaults lie below `--config`, that below `--set`, and that below options of their
/// own; `opnav reference` lists every key.
#[derive(Debug, clap::Args)]
pub struct SettingsArguments {
    /// TOML file of settings, such as the settings.toml of a result, laid over the defaults.
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,
    /// Change one setting; may be repeated. It counts more than --config, and an option of its own counts more than both.
    /// `opnav reference` lists every key.
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = assignment)]
    overrides: Vec<String>,
}

/// Accepts `key=value`.
fn assignment(text: &str) -> Result<String, String> {
    match text.split_once('=') {
        Some((key, _)) if key.split('.').all(|part| !part.trim().is_empty()) => Ok(text.into()),
        _ => Err(format!("'{text}' is not of the form table.key=value")),
    }
}

impl SettingsArguments {
    /// The file and the changes, then `more` changes over them.
    pub fn layers(&self, more: impl IntoIterator<Item = String>) -> Layers {
        Layers { file: self.config.clone(), overrides: self.overrides.iter().cloned().chain(more).collect() }
    }

    /// The settings before options of their own.
    ///
    /// # Errors
    /// Says where a key is unknown, a value of a wrong type or out of range.
    #[cfg(any(feature = "vision", all(feature = "scene", feature = "report")))]
    pub fn resolve<S: Settings>(&self) -> Result<S, SettingsError> {
        self.layers([]).resolve()
    }
}
