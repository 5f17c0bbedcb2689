//! Walk through the JSON schema of a settings type: every table once, with the places where it stands.

use super::section::{KeyChapters, Row, Section};
use super::text::{agreed_default, default_text, kind_text, meaning_text, range_text, single_spaced};
use serde_json::Value;

/// An entry of a table or of a choice as the schema has it.
struct Entry<'a> {
    key: String,
    node: &'a Value,
    /// What describes it.
    words: &'a Value,
    required: bool,
}

/// Where a table stands, and what its keys hold by default in a command.
pub(super) struct Spot<'a> {
    path: String,
    is_list: bool,
    node: &'a Value,
    default: Option<&'a Value>,
}

/// A schema that is gone through.
pub(super) struct Source<'a> {
    pub(super) command: Option<&'a str>,
    pub(super) definitions: &'a Value,
}

impl<'a> Spot<'a> {
    pub(super) fn top(node: &'a Value, default: Option<&'a Value>) -> Self {
        Spot { path: String::new(), is_list: false, node, default }
    }

    fn heading(&self, command: Option<&str>, is_table: bool) -> String {
        let path = &self.path;
        match (command, is_table, self.is_list) {
            (None, ..) if path.is_empty() => "The top of the file".into(),
            (Some(command), ..) if path.is_empty() => format!("`opnav {command}`"),
            (_, true, true) => format!("`[[{path}]]`"),
            (_, true, false) => format!("`[{path}]`"),
            (_, false, _) => format!("`{path}`"),
        }
    }

    fn default_of(&self, key: &str) -> Option<&'a Value> {
        self.default.and_then(|table| table.get(key))
    }
}

impl<'a> Source<'a> {
    /// Notes the table at a spot and every table below it; what another command is made of stands with that command.
    pub(super) fn visit(&self, book: &mut KeyChapters, spot: Spot<'a>) {
        let (type_name, table) = self.target(spot.node);
        let entries = self.entries(table);
        let heading = spot.heading(self.command, table["properties"].is_object());
        let found = book.sections.iter().position(|s| s.type_name == type_name);
        if found.is_some_and(|at| book.sections[at].headings[0].starts_with("`opnav")) {
            return;
        }
        let at = found.unwrap_or(book.sections.len());
        if found.is_none() {
            let about = single_spaced(table["description"].as_str().unwrap_or_default());
            let rows = entries.iter().map(|e| self.row(e)).collect();
            let (headings, commands) = (Vec::new(), Vec::new());
            book.sections.push(Section { type_name: type_name.into(), headings, commands, about, rows });
        }
        let defaults = entries.iter().map(|e| self.default(e, &spot)).collect();
        book.sections[at].add(heading, self.command, defaults);
        for entry in entries {
            let is_list = entry.node["items"].is_object();
            let node = if is_list { &entry.node["items"] } else { entry.node };
            if self.is_table(node) {
                let path =
                    [&spot.path, &entry.key].map(String::as_str).join(if spot.path.is_empty() { "" } else { "." });
                let default = spot.default_of(&entry.key);
                self.visit(book, Spot { path, is_list, node, default });
            }
        }
    }

    fn row(&self, entry: &Entry) -> Row {
        let (_, target) = self.target(entry.node);
        let choice = variants(target).next().is_some();
        Row {
            key: entry.key.clone(),
            kind: match self.is_table(entry.node) {
                true if choice => "choice".into(),
                true => "table".into(),
                false if entry.node["items"]["$ref"].is_string() && !self.is_table(&entry.node["items"]) => {
                    "list of names".into()
                }
                false => kind_text(&entry.key, target),
            },
            defaults: Vec::new(),
            range: range_text(entry.words).unwrap_or_default(),
            meaning: meaning_text(entry.words, target),
        }
    }

    /// The default of a key: a command's own, or else what the type's documentation says.
    fn default(&self, entry: &Entry, spot: &Spot) -> String {
        let said = default_text(entry.node);
        let text = match (self.command, spot.default_of(&entry.key)) {
            (None, _) => said,
            (Some(_), Some(value)) => agreed_default(said, value),
            (Some(_), None) => said,
        };
        let required = if entry.required { "required" } else { "" };
        text.unwrap_or_else(|| required.into())
    }

    /// The keys of a table, or the values and keys of a choice; the keys of a choice's own table stand behind its name.
    fn entries(&self, table: &'a Value) -> Vec<Entry<'a>> {
        if table["properties"].is_object() {
            return properties(table, "");
        }
        let mut entries = Vec::new();
        for variant in variants(table) {
            let entry = |key: String, node: &'a Value| Entry { key, node, words: variant, required: false };
            entries.extend(variant["const"].as_str().map(|name| entry(format!("\"{name}\""), variant)));
            for Entry { key, node, .. } in properties(variant, "") {
                // What a type of its own holds stands in a section of its own.
                let own_type = node["$ref"].is_string();
                entries.push(entry(key.clone(), if own_type { node } else { variant }));
                entries.extend(properties(node, &format!("{key}.")));
            }
        }
        entries
    }

    /// A type's name and what it is, behind references and "or nothing".
    fn target(&self, node: &'a Value) -> (&'a str, &'a Value) {
        let optional = |of: &&Value| of["$ref"].is_string();
        let node = node["anyOf"].as_array().and_then(|any| any.iter().find(optional)).unwrap_or(node);
        match node["$ref"].as_str().and_then(|path| path.strip_prefix("#/$defs/")) {
            Some(name) => (name, &self.definitions[name]),
            None => (node["title"].as_str().unwrap_or_default(), node),
        }
    }

    /// Whether a value is a type with keys of its own: a table, or a choice with a table among its values.
    fn is_table(&self, node: &'a Value) -> bool {
        let (_, target) = self.target(node);
        !std::ptr::eq(node, target) && (target["properties"].is_object() || variants(target).any(is_variant_table))
    }
}

fn is_variant_table(variant: &Value) -> bool {
    variant["properties"].is_object()
}

fn variants(table: &Value) -> impl Iterator<Item = &Value> {
    table["oneOf"].as_array().into_iter().flatten()
}

fn properties<'a>(table: &'a Value, prefix: &str) -> Vec<Entry<'a>> {
    let required = |key: &str| table["required"].as_array().is_some_and(|keys| keys.iter().any(|k| k == key));
    let entry = |(key, node): (&String, &'a Value)| Entry {
        key: format!("{prefix}{key}"),
        node,
        words: node,
        required: required(key),
    };
    table["properties"].as_object().into_iter().flatten().map(entry).collect()
}
