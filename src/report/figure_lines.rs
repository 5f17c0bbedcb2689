//! An evaluation as text.

use super::numbers::{format_number, label_of, unit_label};
use crate::evaluation::Metrics;

/// Verdicts and figures as lines of text, for a terminal.
pub fn figure_lines(metrics: &Metrics) -> Vec<String> {
    let verdicts = metrics.verdicts.iter().map(|v| {
        let answer = if v.holds { "yes" } else { "no" };
        format!("  {:<38} {answer} ({})", label_of(&v.name), v.reason)
    });
    let figures = metrics.figures.iter().map(|f| {
        let bound = f.bound.map(|b| format!("  [{} … {}]", format_number(b.lower), format_number(b.upper)));
        let (name, value, unit) = (label_of(&f.name), format_number(f.value), unit_label(&f.unit));
        format!("  {name:<38} {value:>10} {unit}{}", bound.unwrap_or_default())
    });
    verdicts.chain(figures).collect()
}
