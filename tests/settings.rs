//! Settings of the commands: defaults, files, single changes, and what is refused.

mod keys;
mod layers;
mod ranges;
mod reference;
mod refusals;

use opnav::pipeline::{
    DemoSettings, LandSettings, MonteCarloSettings, TrackSettings, TumbleSettings, command_settings,
};
use opnav::settings::{Layers, Settings};
use std::path::PathBuf;
use tempfile::TempDir;

/// The settings after a file of this text and changes.
fn resolved<S: Settings>(file: Option<&str>, overrides: &[&str]) -> Result<S, String> {
    let folder = TempDir::new().expect("a temporary folder");
    let path = |text: &str| -> PathBuf {
        let path = folder.path().join("mine.toml");
        std::fs::write(&path, text).expect("written");
        path
    };
    let overrides = overrides.iter().map(|line| line.to_string()).collect();
    Layers { file: file.map(path), overrides }.resolve().map_err(|e| e.to_string())
}

/// Whether the settings of a command after changes differ from its defaults, or why they are refused.
fn changes(command: &str, overrides: &[&str]) -> Result<bool, String> {
    fn differs<S: Settings + PartialEq>(overrides: &[&str]) -> Result<bool, String> {
        resolved::<S>(None, overrides).map(|settings| settings != S::default())
    }
    match command {
        "track" => differs::<TrackSettings>(overrides),
        "land" => differs::<LandSettings>(overrides),
        "tumble" => differs::<TumbleSettings>(overrides),
        "montecarlo landing" => differs::<MonteCarloSettings>(overrides),
        "demo" => differs::<DemoSettings>(overrides),
        other => panic!("no settings of {other}"),
    }
}

/// A key of a command with its default.
struct Key {
    command: &'static str,
    path: String,
    default: serde_json::Value,
}

impl Key {
    /// Whether a number may stand here, or a list of them.
    fn is_numeric(&self) -> bool {
        self.default.is_number()
            || self.default.as_array().is_some_and(|a| !a.is_empty() && a.iter().all(|v| v.is_number()))
    }

    fn is_whole(&self) -> bool {
        self.default.as_array().and_then(|a| a.first()).unwrap_or(&self.default).is_u64()
    }

    /// A change that puts the same number into every component.
    fn change(&self, number: &str) -> String {
        match self.default.as_array().map(Vec::len) {
            Some(components) => format!("{}=[{}]", self.path, vec![number; components].join(", ")),
            None => format!("{}={number}", self.path),
        }
    }
}

/// Every key of every command that has a value by default.
fn all_keys() -> Vec<Key> {
    fn walk(command: &'static str, path: &str, value: &serde_json::Value, keys: &mut Vec<Key>) {
        match value.as_object() {
            Some(table) => {
                for (key, value) in table {
                    let below = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
                    walk(command, &below, value, keys);
                }
            }
            None => keys.push(Key { command, path: path.into(), default: value.clone() }),
        }
    }
    let mut keys = Vec::new();
    command_settings().iter().for_each(|c| walk(c.command, "", &c.defaults, &mut keys));
    keys
}
