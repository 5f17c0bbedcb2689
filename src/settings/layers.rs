//! Defaults, a file and single changes, laid over each other.

use super::known_keys::Place;
use super::overrides::{self, Override};
use super::settings_file::{SettingsFile, key_of, one_line};
use super::{OutOfRange, SettingsError};
use schemars::JsonSchema;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::path::PathBuf;
use toml::{Table, Value};

/// The settings of a command: plain data with a default for each key.
pub trait Settings: Serialize + DeserializeOwned + JsonSchema + Default {
    /// Checks every range.
    ///
    /// # Errors
    /// Names the key at fault.
    fn validate(&self) -> Result<(), OutOfRange>;
}

/// What is laid over the defaults: a file, and changes over that.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Layers {
    /// A TOML file.
    pub file: Option<PathBuf>,
    /// Lines of the form `table.key=value`, each value in TOML's notation; quotes may be left out around text.
    pub overrides: Vec<String>,
}

impl From<&Table> for Layers {
    /// A change for each value of a table.
    fn from(table: &Table) -> Self {
        fn lines(path: &str, table: &Table) -> Vec<String> {
            let line = |(key, value): (&String, &Value)| match value {
                Value::Table(below) => lines(&format!("{path}{key}."), below),
                value => vec![format!("{path}{key}={value}")],
            };
            table.iter().flat_map(line).collect()
        }
        Layers { file: None, overrides: lines("", table) }
    }
}

impl From<&[String]> for Layers {
    /// Changes without a file.
    fn from(overrides: &[String]) -> Self {
        Layers { file: None, overrides: overrides.to_vec() }
    }
}

impl Layers {
    /// The settings after all layers, checked.
    ///
    /// # Errors
    /// A file that cannot be read, an unknown key, a value of a wrong type or out of range; the error says where.
    pub fn resolve<S: Settings>(&self) -> Result<S, SettingsError> {
        let defaults = Table::try_from(S::default()).expect("settings are plain data");
        let settings: S = self.over(defaults)?;
        match settings.validate() {
            Ok(()) => Ok(settings),
            Err(fault) => Err(SettingsError::OutOfRange { origin: self.origin(&fault.key), fault }),
        }
    }

    /// The settings after the layers are laid over a table; no range is checked.
    ///
    /// # Errors
    /// A file that cannot be read, an unknown key, or a value of a wrong type; the error says where.
    pub fn over<T: DeserializeOwned + JsonSchema>(&self, mut table: Table) -> Result<T, SettingsError> {
        let schema = schemars::schema_for!(T).to_value();
        let top = Place::top(&schema);
        if let Some(path) = &self.file {
            let file = SettingsFile::read(path)?;
            file.check_keys(&schema)?;
            lay_over(&mut table, &file.table, top);
        }
        for line in &self.overrides {
            Override::parse(line)?.apply(&mut table, top)?;
        }
        table.try_into().map_err(|error| SettingsError::WrongType {
            origin: self.origin(&key_of(&error).unwrap_or_default()),
            problem: one_line(&error, ""),
        })
    }

    /// Where a key was set last, as far as the layers tell.
    fn origin(&self, key: &str) -> String {
        let concerns = |line: &&String| Override::parse(line).is_ok_and(|change| change.concerns(key));
        if let Some(line) = self.overrides.iter().rev().find(concerns) {
            return overrides::origin(line);
        }
        let file = self.file.as_deref().and_then(|path| SettingsFile::read(path).ok());
        file.map_or_else(|| "settings".into(), |file| file.origin(key))
    }
}

/// Lays one table over another: what stands in both is taken from `over`, tables key by key, and another form of a choice
/// takes the whole place.
fn lay_over(base: &mut Table, over: &Table, place: Place) {
    for (key, value) in over {
        let below = place.below(key).unwrap_or(place);
        match (base.get_mut(key), value) {
            (Some(Value::Table(old)), Value::Table(new)) if !below.is_choice() || old.keys().eq(new.keys()) => {
                lay_over(old, new, below);
            }
            _ => {
                base.insert(key.clone(), value.clone());
            }
        }
    }
}

/// The text of a settings file with every key, which reads back to the same settings.
pub fn written(settings: &impl Serialize, command: &str) -> String {
    let table = toml::to_string(settings).expect("settings are plain data");
    format!("# Every setting of `opnav {command}`, as used; `opnav {command} … --config` reads it back.\n{table}")
}
