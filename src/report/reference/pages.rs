//! The pages: every key of a scenario, and every setting of the commands.

use super::schema::{Source, Spot};
use super::section::KeyChapters;
use serde_json::Value;

const SCENARIO: &str = "\
# Every key of a scenario

Made by `opnav reference scenario` from the types that read a scenario: one section a table, with every path at which the
table may stand. A key without \"required\" may be left out; unknown keys are refused. Units: SI unless the key says otherwise,
angles in degrees (`_deg`). A table that is written in part keeps the defaults of its other keys.
Of a choice one line is written, with the keys below it: `exposure = \"auto\"`, or `exposure.fixed = { … }`.
`opnav render`, `map` and `bench render` lay `--config FILE`, with the same keys, over the scenario, and `--set key=value` over
that.
";

const SETTINGS: &str = "\
# Every setting of the commands

Made by `opnav reference settings` from the types that hold them: one section a table, with the commands that have it.
Defaults lie below the file of `--config FILE` (TOML), that below `--set key=value` (`--set front_end.detector.max_features=500`;
may be repeated), and that below options of their own, such as `--descriptor`. A table that is written in part keeps the other
values; unknown keys are refused. Units: SI unless the key says otherwise; degrees only in keys that end in `_deg` or `_deg_s`.
Each command writes `settings.toml` beside its result, with every setting as used; `--config` reads it back.
`opnav render`, `map` and `bench render` read a scenario, whose keys `opnav reference scenario` lists.
";

/// The settings of one command.
#[derive(Debug, Clone, PartialEq)]
pub struct CommandSettings {
    /// The command, such as `land`.
    pub command: &'static str,
    /// JSON schema of the settings: definitions under `$defs`, descriptions from the types' documentation.
    pub schema: Value,
    /// The settings without file and options.
    pub defaults: Value,
}

/// The reference in Markdown; `schema` is a JSON schema of the scenario file: definitions under `$defs`,
/// descriptions from the types' documentation.
pub fn scenario_reference(schema: &Value) -> String {
    let mut book = KeyChapters::default();
    Source { command: None, definitions: &schema["$defs"] }.visit(&mut book, Spot::top(schema, None));
    book.markdown(SCENARIO)
}

/// The reference of the commands' settings in Markdown. A type that several commands have stands there once.
pub fn settings_reference(commands: &[CommandSettings]) -> String {
    let mut book = KeyChapters::default();
    for CommandSettings { command, schema, defaults } in commands {
        let source = Source { command: Some(command), definitions: &schema["$defs"] };
        source.visit(&mut book, Spot::top(schema, Some(defaults)));
    }
    book.markdown(SETTINGS)
}
