//! The reference of a scenario's keys, from the schema of its types.

use super::text::{default_text, kind_text, meaning_text, single_spaced};
use serde_json::Value;

const PREFACE: &str = "\
# Every key of a scenario

Made by `opnav reference` from the types that read a scenario: one section a table, with every path at which the table may
stand. A key without \"required\" may be left out; unknown keys are refused. Units: SI unless the key says otherwise, angles in
degrees (`_deg`). A table that is written in part keeps the defaults of its other keys.
Of a choice one line is written, with the keys below it: `exposure = \"auto\"`, or `exposure.fixed = { … }`.
";

/// A table of keys, or a choice between several.
struct Section {
    type_name: String,
    /// Paths with their brackets: `[sensor]`, `[[cameras]]`.
    headings: Vec<String>,
    about: String,
    rows: Vec<Row>,
}

/// One key.
struct Row {
    key: String,
    kind: String,
    default: String,
    meaning: String,
}

/// An entry of a table or of a choice as the schema has it.
struct Entry<'a> {
    key: String,
    node: &'a Value,
    /// What describes it.
    words: &'a Value,
    required: bool,
}

struct Book<'a> {
    definitions: &'a Value,
    sections: Vec<Section>,
}

/// The reference in Markdown; `schema` is a JSON schema of the scenario file: definitions under `$defs`,
/// descriptions from the types' documentation.
pub fn scenario_reference(schema: &Value) -> String {
    let mut book = Book { definitions: &schema["$defs"], sections: Vec::new() };
    book.visit("", false, schema);
    let sections: Vec<String> = book.sections.iter().map(Section::markdown).collect();
    format!("{PREFACE}\n{}", sections.join("\n"))
}

impl<'a> Book<'a> {
    /// Notes the table at `path` and every table below it.
    fn visit(&mut self, path: &str, is_list: bool, node: &'a Value) {
        let (type_name, table) = self.target(node);
        let entries = self.entries(table);
        let heading = match (table["properties"].is_object(), is_list) {
            _ if path.is_empty() => "The top of the file".into(),
            (true, true) => format!("`[[{path}]]`"),
            (true, false) => format!("`[{path}]`"),
            (false, _) => format!("`{path}`"),
        };
        match self.sections.iter_mut().find(|s| s.type_name == type_name) {
            Some(section) => section.headings.push(heading),
            None => {
                let rows = entries.iter().map(|e| self.row(e)).collect();
                let about = single_spaced(table["description"].as_str().unwrap_or_default());
                self.sections.push(Section { type_name: type_name.into(), headings: vec![heading], about, rows });
            }
        }
        for entry in entries {
            let item = if entry.node["items"].is_object() { &entry.node["items"] } else { entry.node };
            if self.is_table(item) {
                let below = [path, &entry.key].join(if path.is_empty() { "" } else { "." });
                self.visit(&below, item != entry.node, item);
            }
        }
    }

    fn row(&self, entry: &Entry) -> Row {
        let (_, target) = self.target(entry.node);
        let required = if entry.required { "required".into() } else { String::new() };
        let choice = variants(target).next().is_some();
        Row {
            key: entry.key.clone(),
            kind: match self.is_table(entry.node) {
                true if choice => "choice".into(),
                true => "table".into(),
                false => kind_text(&entry.key, target),
            },
            default: default_text(entry.node).unwrap_or(required),
            meaning: meaning_text(entry.words, target),
        }
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

impl Section {
    fn markdown(&self) -> String {
        let headings = self.headings.join(", ");
        let mut text =
            format!("## {headings}\n\n{}\n\n| key | type, unit | default | meaning |\n|---|---|---|---|\n", self.about);
        for Row { key, kind, default, meaning } in &self.rows {
            text += &format!("| `{key}` | {kind} | {default} | {meaning} |\n");
        }
        text
    }
}
