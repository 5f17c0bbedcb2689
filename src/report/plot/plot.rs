//! Drawing one figure of stacked panels that share their time axis.

use super::axis::Axis;
use crate::report::error::ReportError;
use plotters::coord::Shift;
use plotters::prelude::*;

/// A line of a legend.
#[derive(Debug, Clone, PartialEq)]
pub struct LegendEntry {
    /// Colour as CSS; empty for a remark without one.
    pub color: String,
    /// What the colour stands for.
    pub label: String,
}

/// A finished plot.
#[derive(Debug, Clone, PartialEq)]
pub struct Plot {
    /// What it shows.
    pub title: String,
    /// The drawing, an `svg` element.
    pub svg: String,
    /// The colours, explained.
    pub legend: Vec<LegendEntry>,
}

/// Deep blue: the quantity itself.
pub const LINE: RGBColor = RGBColor(31, 78, 121);
/// Pale blue: where the estimator believes the truth to be.
pub const BAND: RGBColor = RGBColor(168, 195, 220);
/// Burnt orange: a limit or an expectation.
pub const LIMIT: RGBColor = RGBColor(191, 104, 32);
pub(super) const GRID: RGBColor = RGBColor(226, 230, 235);
pub(super) const FRAME: RGBColor = RGBColor(140, 149, 160);
pub(super) const TEXT: RGBColor = RGBColor(60, 70, 82);

/// Units of the drawing in a pixel of the page: the plotter rounds to whole units, which must not show.
pub(super) const FINE: u32 = 4;
pub(super) const WIDTH: u32 = 860;

/// What is drawn in a panel, back to front.
pub enum Layer {
    /// A filled band between ± the values.
    Band(Vec<(f64, f64)>),
    /// A line.
    Line(Vec<(f64, f64)>, RGBColor),
    /// Dots.
    Dots(Vec<(f64, f64)>),
    /// A level line over the whole width.
    Level(f64, RGBColor),
}

/// One panel.
pub struct Panel {
    /// Label of the vertical axis, unit included.
    pub label: String,
    /// The vertical axis.
    pub axis: Axis,
    /// What is drawn.
    pub layers: Vec<Layer>,
}

/// Draws panels over a common time axis in s.
///
/// # Errors
/// [`ReportError::Plot`] if the plotter fails.
pub fn draw_panels(title: &str, time: &Axis, panels: &[Panel], height: u32) -> Result<String, ReportError> {
    let foot = 44;
    let size = (WIDTH * FINE, (panels.len() as u32 * height + foot) * FINE);
    let mut svg = String::new();
    {
        let mut rest = SVGBackend::with_string(&mut svg, size).into_drawing_area();
        for (index, panel) in panels.iter().enumerate() {
            let last = index + 1 == panels.len();
            let (area, below) = rest.split_vertically(((height + if last { foot } else { 0 }) * FINE) as i32);
            let drawn = draw_panel(&area, time, panel, if last { foot } else { 0 });
            drawn.map_err(|problem| ReportError::Plot { title: title.into(), problem })?;
            rest = below;
        }
    }
    Ok(accessible(&svg, title))
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

fn draw_panel(area: &Area<'_>, time: &Axis, panel: &Panel, foot: u32) -> Result<(), String> {
    let text = |size: u32| ("sans-serif", f64::from(size * FINE) * 1.24).into_font().color(&TEXT);
    let mut builder = ChartBuilder::on(area);
    builder.margin_top(10 * FINE).margin_right(14 * FINE).margin_bottom(4 * FINE);
    builder.y_label_area_size(78 * FINE).x_label_area_size(foot * FINE);
    let mut chart = builder.build_cartesian_2d(time.clone(), panel.axis.clone()).map_err(|e| e.to_string())?;
    let mut mesh = chart.configure_mesh();
    mesh.bold_line_style(GRID.stroke_width(FINE)).axis_style(FRAME.stroke_width(FINE));
    mesh.label_style(text(12)).axis_desc_style(text(12)).y_desc(panel.label.clone());
    mesh.set_all_tick_mark_size(4 * FINE);
    if foot > 0 {
        mesh.x_desc("time (s)");
    }
    mesh.draw().map_err(|e| e.to_string())?;
    let (start, end) =
        (plotters::coord::ranged1d::Ranged::range(time).start, plotters::coord::ranged1d::Ranged::range(time).end);
    for layer in &panel.layers {
        let drawn = match layer {
            Layer::Band(points) => {
                let back = points.iter().rev().map(|(t, v)| (*t, -v));
                let outline: Vec<(f64, f64)> = points.iter().copied().chain(back).collect();
                chart.draw_series([Polygon::new(outline, BAND.mix(0.55).filled())]).map(drop)
            }
            Layer::Line(points, color) => {
                let style = color.stroke_width(FINE * 3 / 2);
                chart.draw_series([PathElement::new(points.clone(), style)]).map(drop)
            }
            Layer::Dots(points) => {
                let dot = |point: &(f64, f64)| Circle::new(*point, 2 * FINE, LINE.mix(0.7).filled());
                chart.draw_series(points.iter().map(dot)).map(drop)
            }
            Layer::Level(value, color) => {
                let style = color.stroke_width(FINE);
                chart.draw_series([PathElement::new(vec![(start, *value), (end, *value)], style)]).map(drop)
            }
        };
        drawn.map_err(|e| e.to_string())?;
    }
    Ok(())
}

/// The drawing with a title for screen readers and a size that follows the page.
pub(super) fn accessible(svg: &str, title: &str) -> String {
    let body = svg.find("viewBox").map_or(svg, |start| &svg[start..]);
    let label = maud::html! { title { (title) } }.into_string();
    let (open, rest) = body.split_once('>').unwrap_or((body, ""));
    format!("<svg role=\"img\" {open}>{label}{rest}")
}
