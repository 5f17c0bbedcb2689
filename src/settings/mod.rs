//! Settings: one way for every room and every command.
//!
//! A settings type is a plain struct with a documented default for each field. [`limits`] checks ranges, and every fault is
//! an [`OutOfRange`] that names the key. [`Layers`] lays a TOML file (`--config`) and single changes (`--set`) over the
//! defaults; a key that no type has is refused with its place and the nearest key that there is. [`written`] gives the
//! resolved copy, which reads back to the same settings.

mod error;
mod known_keys;
mod layers;
pub mod limits;
mod overrides;
mod settings_file;

pub use error::{OutOfRange, SettingsError};
pub use layers::{Layers, Settings, written};
pub use settings_file::SettingsFile;
