//! What can be wrong with settings, each error naming the place, the key and the cure.

use std::fmt::Display;
use std::path::PathBuf;
use thiserror::Error;

/// A setting outside its range, or one that contradicts another.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{key} is {value}: {cure}")]
pub struct OutOfRange {
    /// The key with its tables, as in a file.
    pub key: String,
    /// The value found.
    pub value: String,
    /// What it may be.
    pub cure: String,
}

impl OutOfRange {
    /// A setting outside its range.
    pub fn new(key: impl Into<String>, value: impl Display, cure: impl Display) -> Self {
        OutOfRange { key: key.into(), value: value.to_string(), cure: cure.to_string() }
    }

    /// Puts the name of the enclosing table before the key.
    pub fn under(self, table: &str) -> Self {
        OutOfRange { key: format!("{table}.{}", self.key), ..self }
    }
}

/// Why settings could not be read. `origin` is a file with its line, or the option of the command line.
#[derive(Debug, Error)]
pub enum SettingsError {
    /// The operating system refused.
    #[error("could not read the settings {}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// Text that is no TOML, or a change that is not of the form `table.key=value`.
    #[error("{origin}: {problem}")]
    Malformed {
        /// Where it stands.
        origin: String,
        /// What is wrong and what to do.
        problem: String,
    },
    /// A key that no setting has.
    #[error("{origin}: there is no key {key}{hint}; `opnav reference` lists all")]
    UnknownKey {
        /// Where it stands.
        origin: String,
        /// The key with its tables.
        key: String,
        /// The nearest key that there is, in words; empty if none is near.
        hint: String,
    },
    /// A value of another type than its key's, or a key that lacks.
    #[error("{origin}: {problem}")]
    WrongType {
        /// Where it stands.
        origin: String,
        /// What was expected, and the key.
        problem: String,
    },
    /// A value outside its range.
    #[error("{origin}: {fault}")]
    OutOfRange {
        /// Where it stands.
        origin: String,
        /// Key, value and cure.
        #[source]
        fault: OutOfRange,
    },
}
