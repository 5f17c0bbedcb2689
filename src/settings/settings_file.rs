//! Settings in a file, with the lines of their keys.

use super::SettingsError;
use super::known_keys::{Place, hint};
use std::path::{Path, PathBuf};
use toml::de::{DeTable, DeValue};
use toml::{Table, Value};

/// A TOML file of settings.
#[derive(Debug, Clone, PartialEq)]
pub struct SettingsFile {
    path: PathBuf,
    text: String,
    /// What the file holds.
    pub table: Table,
}

impl SettingsFile {
    /// Reads a file.
    ///
    /// # Errors
    /// The file cannot be read, or is no TOML; then its line is named.
    pub fn read(path: &Path) -> Result<Self, SettingsError> {
        let text = std::fs::read_to_string(path).map_err(|source| SettingsError::Io { path: path.into(), source })?;
        SettingsFile::parse(&text, path)
    }

    /// Reads text; `path` is what errors name.
    ///
    /// # Errors
    /// The text is no TOML.
    pub fn parse(text: &str, path: &Path) -> Result<Self, SettingsError> {
        let table = toml::from_str(text).map_err(|error| SettingsError::Malformed {
            origin: path.display().to_string(),
            problem: one_line(&error, text),
        })?;
        Ok(SettingsFile { path: path.into(), text: text.into(), table })
    }

    /// Refuses keys that the settings of a JSON schema do not have.
    ///
    /// # Errors
    /// [`SettingsError::UnknownKey`] with line and nearest key.
    pub fn check_keys(&self, schema: &serde_json::Value) -> Result<(), SettingsError> {
        let top = Place::top(schema);
        match unknown(&self.table, top) {
            None => Ok(()),
            Some(keys) => {
                let (key, hint) = (keys.join("."), hint(&keys.join("."), &top.paths()));
                Err(SettingsError::UnknownKey { origin: self.origin(&key), key, hint })
            }
        }
    }

    /// The settings as a type that has them all.
    ///
    /// # Errors
    /// A value of a wrong type or a key that lacks, with its line.
    pub fn deserialized<T: serde::de::DeserializeOwned>(&self) -> Result<T, SettingsError> {
        toml::from_str(&self.text).map_err(|error| SettingsError::WrongType {
            origin: self.path.display().to_string(),
            problem: one_line(&error, &self.text),
        })
    }

    /// The file, with the line where a key stands if it does.
    pub(super) fn origin(&self, key: &str) -> String {
        let line = self.line_of(key).map(|line| format!(", line {line}")).unwrap_or_default();
        format!("{}{line}", self.path.display())
    }

    /// Line, from 1, of a key, or of the table nearest above it.
    fn line_of(&self, key: &str) -> Option<usize> {
        let document = DeTable::parse(&self.text).ok()?;
        let mut table = Some(document.get_ref());
        let mut found = None;
        for part in key.split('.') {
            let Some((name, value)) = table.and_then(|t| t.iter().find(|(name, _)| name.get_ref() == part)) else {
                break;
            };
            found = Some(name.span().start);
            table = match value.get_ref() {
                DeValue::Table(table) => Some(table),
                _ => None,
            };
        }
        found.map(|at| 1 + self.text[..at].matches('\n').count())
    }
}

/// The first key that does not belong where it stands, with its tables.
fn unknown(table: &Table, place: Place) -> Option<Vec<String>> {
    table.iter().find_map(|(key, value)| {
        let Some(below) = place.below(key) else { return Some(vec![key.clone()]) };
        let deeper = match value {
            Value::Table(table) => unknown(table, below),
            Value::Array(entries) => entries.iter().enumerate().find_map(|(index, entry)| {
                let index = index.to_string();
                let found = unknown(entry.as_table()?, below.below(&index)?)?;
                Some([vec![index], found].concat())
            }),
            _ => None,
        };
        deeper.map(|found| [vec![key.clone()], found].concat())
    })
}

/// What a TOML error says, in one line, with its line and key.
pub(super) fn one_line(error: &toml::de::Error, text: &str) -> String {
    let key = key_of(error).map(|key| format!(" (in `{key}`)"));
    let line = error.span().and_then(|span| text.get(..span.start)).map(|before| before.lines().count().max(1));
    let starts_line = error.span().is_some_and(|span| text[..span.start.min(text.len())].ends_with('\n'));
    let place = line.map(|n| format!("line {}: ", n + usize::from(starts_line))).unwrap_or_default();
    format!("{place}{}{}", error.message().replace('\n', " "), key.unwrap_or_default())
}

/// The key that a TOML error names.
pub(super) fn key_of(error: &toml::de::Error) -> Option<String> {
    let whole = error.to_string();
    let line = whole.lines().rev().find_map(|line| line.strip_prefix("in `"))?;
    Some(line.trim_end_matches('`').to_string())
}
