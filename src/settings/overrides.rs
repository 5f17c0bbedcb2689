//! Single changes of settings: `table.key=value`.

use super::SettingsError;
use super::known_keys::{Place, hint};
use toml::{Table, Value};

/// A change as it stands on the command line.
pub(super) struct Override<'a> {
    line: &'a str,
    keys: Vec<&'a str>,
    value: Value,
}

impl<'a> Override<'a> {
    /// Reads `table.key=value`, the value in TOML's notation; quotes may be left out around text.
    ///
    /// # Errors
    /// [`SettingsError::Malformed`] shows the form.
    pub fn parse(line: &'a str) -> Result<Self, SettingsError> {
        let malformed = |problem: &str| SettingsError::Malformed { origin: origin(line), problem: problem.into() };
        let (path, text) = line.split_once('=').ok_or_else(|| malformed("write it as table.key=value"))?;
        let keys: Vec<&str> = path.split('.').map(str::trim).collect();
        if keys.iter().any(|key| key.is_empty()) {
            return Err(malformed("the key is empty"));
        }
        Ok(Override { line, keys, value: value(text.trim()) })
    }

    /// Whether it changes this key, a table above it or a value below it.
    pub fn concerns(&self, key: &str) -> bool {
        self.keys.iter().zip(key.split('.')).all(|(own, other)| *own == other)
    }

    /// Puts the value into a table, or into an entry of a list (`tables.0.key=value`); missing tables on the way are made,
    /// and another form of a choice makes room.
    ///
    /// # Errors
    /// No such key or entry.
    pub fn apply(&self, table: &mut Table, top: Place) -> Result<(), SettingsError> {
        if self.leads_nowhere(top) {
            let key = self.keys.join(".");
            return Err(SettingsError::UnknownKey { origin: origin(self.line), hint: hint(&key, &top.paths()), key });
        }
        let mut whole = Value::Table(std::mem::take(table));
        let result = put(&mut whole, (&self.keys, &self.value), top);
        if let Value::Table(changed) = whole {
            *table = changed;
        }
        result.map_err(|problem| SettingsError::Malformed { origin: origin(self.line), problem })
    }

    fn leads_nowhere(&self, top: Place) -> bool {
        self.keys.iter().try_fold(top, |place, key| place.below(key)).is_none()
    }
}

/// How a change is named in errors.
pub(super) fn origin(line: &str) -> String {
    format!("--set {line}")
}

/// Puts a value below keys into what stands at a place.
fn put(slot: &mut Value, (keys, value): (&[&str], &Value), place: Place) -> Result<(), String> {
    let Some((key, keys)) = keys.split_first() else {
        *slot = value.clone();
        return Ok(());
    };
    let below = place.below(key).unwrap_or(place);
    if place.is_choice() && !slot.as_table().is_some_and(|form| form.contains_key(*key)) {
        *slot = empty_table();
    }
    match slot {
        Value::Table(table) => {
            let next = table.entry(*key).or_insert_with(empty_table);
            let told =
                |problem: String| if problem.is_empty() { format!("{key} is a value, not a table") } else { problem };
            put(next, (keys, value), below).map_err(told)
        }
        Value::Array(entries) => {
            let entry = key.parse::<usize>().ok().and_then(|index| entries.get_mut(index));
            let entry = entry.ok_or_else(|| format!("there is no entry {key} (counted from 0)"))?;
            put(entry, (keys, value), below)
        }
        // The caller knows the key that is none.
        _ => Err(String::new()),
    }
}

fn empty_table() -> Value {
    Value::Table(Table::new())
}

/// A value in TOML's notation; anything else is text.
fn value(text: &str) -> Value {
    let parsed: Option<Table> = toml::from_str(&format!("value = {text}")).ok();
    parsed
        .filter(|table| table.len() == 1)
        .and_then(|mut table| table.remove("value"))
        .unwrap_or_else(|| Value::String(text.into()))
}
