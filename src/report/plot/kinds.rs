//! The plots of a report: errors in their envelopes, consistency, sizes of errors.

use super::axis::Axis;
use super::plot::{BAND, LIMIT, LINE, Layer, LegendEntry, Panel, Plot, draw_panels};
use crate::report::error::ReportError;
use crate::report::numbers::unit_label;
use crate::stats::ConsistencyBounds;
use plotters::style::RGBColor;

/// A curve over time to plot.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve<'a> {
    /// Short name, such as `x`.
    pub label: String,
    /// Times in s.
    pub t_s: &'a [f64],
    /// Values, one a time.
    pub values: &'a [f64],
    /// 1σ, one a time, or nothing.
    pub sigma: &'a [f64],
}

const MOST_POINTS: usize = 700;

/// Errors (true less estimated) of several components, one panel each, in the ±3σ envelope that the estimator claims.
/// The axis covers decades where the errors do.
///
/// # Errors
/// [`ReportError::Plot`] if the plotter fails.
pub fn error_with_envelope(title: &str, unit: &str, curves: &[Curve<'_>]) -> Result<Plot, ReportError> {
    let panels: Vec<Panel> = curves.iter().map(|curve| error_panel(unit, curve)).collect();
    let svg = draw_panels(title, &time_axis(curves), &panels, if curves.len() > 1 { 132 } else { 200 })?;
    let mut legend = vec![entry(LINE, "error (true − estimated)")];
    if curves.iter().any(|c| !c.sigma.is_empty()) {
        legend.push(entry(BAND, "±3σ of the estimator"));
    }
    if panels.iter().any(|panel| panel.axis.bends()) {
        legend
            .push(LegendEntry { color: String::new(), label: "vertical axis: even near 0, logarithmic beyond".into() });
    }
    Ok(Plot { title: title.into(), svg, legend })
}

fn error_panel(unit: &str, curve: &Curve<'_>) -> Panel {
    let kept = thinned(curve.values);
    let at = |values: &[f64], scale: f64| -> Vec<(f64, f64)> {
        kept.iter().filter(|k| values[**k].is_finite()).map(|k| (curve.t_s[*k], values[*k] * scale)).collect()
    };
    let errors = at(curve.values, 1.0);
    let envelope = if curve.sigma.is_empty() { vec![] } else { at(curve.sigma, 3.0) };
    let sizes: Vec<f64> = errors.iter().chain(&envelope).map(|(_, v)| v.abs()).collect();
    let label = axis_label(&curve.label, unit);
    let zero = Layer::Level(0.0, RGBColor(150, 158, 168));
    Panel {
        label,
        axis: Axis::for_errors(&sizes),
        layers: vec![Layer::Band(envelope), zero, Layer::Line(errors, LINE)],
    }
}

/// Normalised errors squared over time against the 95 % bounds of one epoch, on a logarithmic axis; 1 is perfect.
///
/// # Errors
/// [`ReportError::Plot`] if the plotter fails.
pub fn consistency_plot(title: &str, curve: &Curve<'_>, bounds: &ConsistencyBounds) -> Result<Plot, ReportError> {
    let points = positive_points(curve, curve.values);
    let values = || points.iter().map(|(_, v)| *v);
    let low = values().fold(bounds.lower, f64::min).max(1e-3 * bounds.lower);
    let high = values().fold(bounds.upper, f64::max);
    let layers = vec![
        Layer::Level(bounds.lower, LIMIT),
        Layer::Level(bounds.upper, LIMIT),
        Layer::Level(1.0, RGBColor(150, 158, 168)),
        Layer::Line(points, LINE),
    ];
    let panel = Panel { label: curve.label.clone(), axis: Axis::log(0.8 * low, 1.3 * high), layers };
    let svg = draw_panels(title, &time_axis(std::slice::from_ref(curve)), &[panel], 200)?;
    let legend = vec![entry(LINE, "normalised error squared"), entry(LIMIT, "95 % χ² bounds of one epoch")];
    Ok(Plot { title: title.into(), svg, legend })
}

/// Sizes of errors over time as dots on a logarithmic axis, and the size that their 1σ lets expect.
///
/// # Errors
/// [`ReportError::Plot`] if the plotter fails.
pub fn magnitude_plot(title: &str, unit: &str, curve: &Curve<'_>) -> Result<Plot, ReportError> {
    let points = positive_points(curve, curve.values);
    let expected = if curve.sigma.is_empty() { vec![] } else { positive_points(curve, curve.sigma) };
    let values = || points.iter().chain(&expected).map(|(_, v)| *v);
    let axis = Axis::log(0.7 * values().fold(f64::INFINITY, f64::min), 1.4 * values().fold(0.0, f64::max));
    let mut legend = vec![entry(LINE, "error")];
    if !expected.is_empty() {
        legend.push(entry(LIMIT, "expected (r.m.s. by the stated 1σ)"));
    }
    let layers = vec![Layer::Line(expected, LIMIT), Layer::Dots(points)];
    let panel = Panel { label: axis_label(&curve.label, unit), axis, layers };
    let svg = draw_panels(title, &time_axis(std::slice::from_ref(curve)), &[panel], 220)?;
    Ok(Plot { title: title.into(), svg, legend })
}

fn positive_points(curve: &Curve<'_>, values: &[f64]) -> Vec<(f64, f64)> {
    let kept = thinned(values);
    kept.into_iter().filter(|k| values[*k] > 0.0 && values[*k].is_finite()).map(|k| (curve.t_s[k], values[k])).collect()
}

fn time_axis(curves: &[Curve<'_>]) -> Axis {
    let times = || curves.iter().flat_map(|c| c.t_s.iter().copied());
    let (low, high) = (times().fold(f64::INFINITY, f64::min), times().fold(f64::NEG_INFINITY, f64::max));
    if low.is_finite() { Axis::linear(low, high, 9) } else { Axis::linear(0.0, 1.0, 4) }
}

fn axis_label(label: &str, unit: &str) -> String {
    let unit = unit_label(unit);
    if unit.is_empty() { label.into() } else { format!("{label} ({unit})") }
}

fn entry(color: RGBColor, label: &str) -> LegendEntry {
    LegendEntry { color: format!("rgb({}, {}, {})", color.0, color.1, color.2), label: label.into() }
}

/// Indices of at most about [`MOST_POINTS`] points: of every run of neighbours the one farthest from zero, so that no
/// peak is lost; always the first and the last.
fn thinned(values: &[f64]) -> Vec<usize> {
    let run = values.len().div_ceil(MOST_POINTS).max(1);
    let farthest = |start: usize| {
        let end = (start + run).min(values.len());
        (start..end).max_by(|a, b| values[*a].abs().total_cmp(&values[*b].abs())).unwrap_or(start)
    };
    let mut kept: Vec<usize> = (0..values.len()).step_by(run).map(farthest).collect();
    if run > 1 {
        kept.extend([0, values.len() - 1]);
        kept.sort_unstable();
        kept.dedup();
    }
    kept
}
