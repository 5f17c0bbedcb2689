//! Strict reading of result tables: a fixed header, then rows of words and numbers.

use crate::dataset::DatasetError;
use std::path::Path;

/// The fields of one row.
pub(super) struct Row<'a> {
    names: Vec<&'a str>,
    fields: Vec<&'a str>,
}

impl<'a> Row<'a> {
    /// The field's text.
    pub(super) fn word(&self, column: usize) -> &'a str {
        self.fields[column]
    }

    /// The field as a whole number.
    pub(super) fn whole<T: std::str::FromStr>(&self, column: usize) -> Result<T, String> {
        let text = self.fields[column];
        text.parse().map_err(|_| format!("{} is '{text}': a whole number is expected", self.names[column]))
    }

    /// The field as a finite number.
    pub(super) fn number(&self, column: usize) -> Result<f64, String> {
        let text = self.fields[column];
        match text.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(format!("{} is '{text}': a finite number is expected", self.names[column])),
        }
    }
}

/// Reads a table that has exactly this `header` (a leading `#` is allowed), each row through `parse`.
pub(super) fn read_rows<T>(
    path: &Path,
    header: &str,
    parse: impl Fn(&Row) -> Result<T, String>,
) -> Result<Vec<T>, DatasetError> {
    if !path.exists() {
        let cure = "check the folder's path, or run `opnav track` first".into();
        return Err(DatasetError::Missing { path: path.into(), cure });
    }
    let text = std::fs::read_to_string(path).map_err(DatasetError::io("read", path))?;
    let malformed =
        |line: usize, problem: String| DatasetError::Malformed { path: path.into(), line: line as u64 + 1, problem };
    let found = text.lines().next().unwrap_or("").trim().trim_start_matches('#').trim();
    if found.split(',').map(str::trim).ne(header.split(',')) {
        return Err(malformed(0, format!("the header is '{found}', and '{header}' is expected")));
    }
    let names: Vec<&str> = header.split(',').collect();
    let mut rows = Vec::new();
    for (number, line) in text.lines().enumerate().skip(1).filter(|(_, line)| !line.trim().is_empty()) {
        let fields: Vec<&str> = line.split(',').map(str::trim).collect();
        if fields.len() != names.len() {
            return Err(malformed(number, format!("{} columns found, {} expected", fields.len(), names.len())));
        }
        rows.push(parse(&Row { names: names.clone(), fields }).map_err(|problem| malformed(number, problem))?);
    }
    Ok(rows)
}
