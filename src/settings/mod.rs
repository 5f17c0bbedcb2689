//! Settings: one way for every room and every command.
//!
//! A settings type is a plain struct with a documented default for each field. [`limits`] checks ranges, and every fault is
//! an [`OutOfRange`] that names the key. `Layers` lays a TOML file (`--config`) and single changes (`--set`) over the
//! defaults; a key that no type has is refused with its place and the nearest key that there is. `written` gives the
//! resolved copy, which reads back to the same settings.
//!
//! Ranges and faults are always there; files and changes need the feature `settings`, which brings the types' schemas.

mod error;
#[cfg(feature = "settings")]
mod known_keys;
#[cfg(feature = "settings")]
mod layers;
pub mod limits;
#[cfg(feature = "settings")]
mod overrides;
#[cfg(feature = "settings")]
mod settings_file;

pub use error::{OutOfRange, SettingsError};
#[cfg(feature = "settings")]
pub use layers::{Layers, Settings, written};
#[cfg(feature = "settings")]
pub use settings_file::SettingsFile;
