//! The reference of a scenario's keys and of the commands' settings in Markdown: `schema` walks the JSON schema that
//! the types give, `section` is a table of keys, `pages` puts the two pages together, `text` writes units, defaults and
//! ranges as sentences. It needs no feature: a schema is plain data.

mod pages;
mod schema;
mod section;
mod text;

pub use pages::{CommandSettings, scenario_reference, settings_reference};
