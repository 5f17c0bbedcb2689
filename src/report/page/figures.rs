//! Tables of a report.

use super::page::Block;
use crate::evaluation::{Figure, Metrics};
use crate::report::numbers::{format_number, label_of, unit_label};
use serde_json::Value;

/// Table of figures with units and, where there are any, the bounds to keep.
pub fn figure_table<'a>(caption: &str, figures: impl IntoIterator<Item = &'a Figure>) -> Block {
    let figures: Vec<&Figure> = figures.into_iter().collect();
    let bounded = figures.iter().any(|f| f.bound.is_some());
    let mut header = vec!["figure".to_string(), "value".into(), "unit".into()];
    if bounded {
        header.push("95 % bounds".into());
    }
    let row = |figure: &&Figure| {
        let mut row = vec![label_of(&figure.name), format_number(figure.value), unit_label(&figure.unit)];
        if bounded {
            let bounds = figure.bound.map(|b| format!("{} … {}", format_number(b.lower), format_number(b.upper)));
            row.push(bounds.unwrap_or_default());
        }
        row
    };
    Block::Table { caption: caption.into(), header, rows: figures.iter().map(row).collect() }
}

/// Time a stage took, from the object `timing_ms` (stage to ms) of a result's summary; `None` without one.
pub fn timing_table(summary: &Value) -> Option<Block> {
    let stages = summary.get("timing_ms")?.as_object()?;
    let rows: Vec<Vec<String>> = stages
        .iter()
        .filter_map(|(stage, value)| Some(vec![label_of(stage), format_number(value.as_f64()?), "ms".into()]))
        .collect();
    let header = ["stage", "time", "unit"].map(String::from).to_vec();
    (!rows.is_empty()).then(|| Block::Table { caption: "Time taken".into(), header, rows })
}

/// Table of names and values, such as version, adapter, operating system.
pub fn environment_table(entries: &[(String, String)]) -> Block {
    let rows = entries.iter().map(|(name, value)| vec![name.clone(), value.clone()]).collect();
    Block::Table { caption: "Environment".into(), header: vec!["what".into(), "which".into()], rows }
}

/// Figures whose names begin with one of the prefixes, in the metrics' order.
pub(super) fn figures_with<'a>(metrics: &'a Metrics, prefixes: &[&str]) -> Vec<&'a Figure> {
    metrics.figures.iter().filter(|f| prefixes.iter().any(|p| f.name.starts_with(p))).collect()
}
