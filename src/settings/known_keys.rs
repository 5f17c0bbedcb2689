//! The keys that a settings type has, from its JSON schema.

use serde_json::Value;

/// A place among settings: a table, a choice between several, a list or a plain value.
#[derive(Clone, Copy)]
pub(super) struct Place<'a> {
    /// `None` where anything may stand.
    node: Option<&'a Value>,
    definitions: &'a Value,
}

impl<'a> Place<'a> {
    /// The top of a settings type, given its schema.
    pub fn top(schema: &'a Value) -> Self {
        Place { node: Some(schema), definitions: &schema["$defs"] }
    }

    /// What stands below a key; `None` if the table or choice has no such key.
    pub fn below(&self, key: &str) -> Option<Self> {
        let Some(node) = self.resolved() else { return Some(*self) };
        if node["items"].is_object() && key.parse::<usize>().is_ok() {
            return Some(self.at(&node["items"]));
        }
        let mut tables = tables(node).peekable();
        if tables.peek().is_none() && node["oneOf"].is_null() {
            return Some(Place { node: None, ..*self });
        }
        tables.find_map(|table| table.get(key)).map(|node| self.at(node))
    }

    /// Whether one of several forms stands here, so that another form takes the whole place.
    pub fn is_choice(&self) -> bool {
        self.resolved().is_some_and(|node| node["oneOf"].is_array())
    }

    /// Every key from here down to plain values, with its tables; `0` stands for the entries of a list.
    pub fn paths(&self) -> Vec<String> {
        let Some(node) = self.resolved() else { return Vec::new() };
        let children = tables(node).flatten().map(|(key, node)| (key.as_str(), self.at(node)));
        let entries = node["items"].is_object().then(|| ("0", self.at(&node["items"])));
        let paths = children.chain(entries).flat_map(|(key, place)| {
            let below = place.paths();
            let own = (below.is_empty() || place.is_choice()).then(|| key.to_string()).filter(|key| key != "0");
            own.into_iter().chain(below.into_iter().map(move |path| format!("{key}.{path}")))
        });
        paths.collect()
    }

    fn at(&self, node: &'a Value) -> Self {
        Place { node: Some(node), ..*self }
    }

    /// The node behind references and "or nothing".
    fn resolved(&self) -> Option<&'a Value> {
        let node = self.node?;
        let referring = |of: &&Value| of["$ref"].is_string();
        let node = node["anyOf"].as_array().and_then(|any| any.iter().find(referring)).unwrap_or(node);
        match node["$ref"].as_str().and_then(|path| path.strip_prefix("#/$defs/")) {
            Some(name) => self.definitions.get(name),
            None => Some(node),
        }
    }
}

/// The keys of a table, or those of each form of a choice.
fn tables(node: &Value) -> impl Iterator<Item = &serde_json::Map<String, Value>> {
    let forms = node["oneOf"].as_array().into_iter().flatten();
    std::iter::once(node).chain(forms).filter_map(|form| form["properties"].as_object())
}

/// The nearest of `paths` to a key that is not among them, in words; empty if none is near.
pub(super) fn hint(key: &str, paths: &[String]) -> String {
    const LEAST_LIKENESS: f64 = 0.6;
    let last = |path: &str| path.rsplit('.').next().unwrap_or_default().to_string();
    let own = last(key);
    let likeness = |path: &String| {
        let ends = strsim::normalized_damerau_levenshtein(&own, &last(path));
        (ends, ends + strsim::normalized_damerau_levenshtein(key, path))
    };
    let near = paths.iter().map(|path| (likeness(path), path)).filter(|((ends, _), _)| *ends >= LEAST_LIKENESS);
    let nearest = near.max_by(|((_, a), _), ((_, b), _)| a.total_cmp(b));
    nearest.map(|(_, path)| format!(": did you mean {path}?")).unwrap_or_default()
}
