//! Charts that are no curves over time: boxes side by side, and a map of values over the ground.

use super::axis::Axis;
use super::plot::{FINE, FRAME, GRID, LIMIT, LINE, TEXT, WIDTH, accessible};
use crate::report::error::ReportError;
use plotters::prelude::*;

/// Five numbers of a distribution: whisker, quartile, median, quartile, whisker.
pub struct Box {
    /// What it is of.
    pub label: String,
    /// In ascending order, positive.
    pub values: [f64; 5],
}

fn text(size: u32) -> TextStyle<'static> {
    ("sans-serif", f64::from(size * FINE) * 1.24).into_font().color(&TEXT)
}

/// Boxes side by side on a logarithmic axis.
///
/// # Errors
/// [`ReportError::Plot`] if the plotter fails.
pub fn draw_boxes(title: &str, label: &str, boxes: &[Box]) -> Result<String, ReportError> {
    let mut svg = String::new();
    draw_boxes_into(&mut svg, label, boxes).map_err(|problem| ReportError::Plot { title: title.into(), problem })?;
    Ok(accessible(&svg, title))
}

fn draw_boxes_into(svg: &mut String, label: &str, boxes: &[Box]) -> Result<(), String> {
    let area = SVGBackend::with_string(svg, (WIDTH * FINE, 300 * FINE)).into_drawing_area();
    let all = || boxes.iter().flat_map(|b| b.values);
    let axis = Axis::log(0.5 * all().fold(f64::INFINITY, f64::min), 2.0 * all().fold(0.0, f64::max));
    let mut builder = ChartBuilder::on(&area);
    builder.margin_top(10 * FINE).margin_right(14 * FINE).y_label_area_size(78 * FINE).x_label_area_size(40 * FINE);
    let across = Axis::linear(0.0, boxes.len().max(1) as f64, 1);
    let mut chart = builder.build_cartesian_2d(across, axis.clone()).map_err(|e| e.to_string())?;
    let mut mesh = chart.configure_mesh();
    mesh.disable_x_mesh().disable_x_axis().bold_line_style(GRID.stroke_width(FINE));
    mesh.axis_style(FRAME.stroke_width(FINE)).label_style(text(12)).axis_desc_style(text(12)).y_desc(label);
    mesh.draw().map_err(|e| e.to_string())?;
    let stroke = LINE.stroke_width(FINE * 3 / 2);
    for (k, one) in boxes.iter().enumerate() {
        let middle = k as f64 + 0.5;
        let [low, first, median, third, high] = one.values;
        let fill = Rectangle::new([(middle - 0.25, first), (middle + 0.25, third)], LINE.mix(0.25).filled());
        chart.draw_series([fill]).map_err(|e| e.to_string())?;
        let lines = [
            vec![(middle, low), (middle, first)],
            vec![(middle, third), (middle, high)],
            vec![(middle - 0.12, low), (middle + 0.12, low)],
            vec![(middle - 0.12, high), (middle + 0.12, high)],
        ];
        chart.draw_series(lines.map(|line| PathElement::new(line, stroke))).map_err(|e| e.to_string())?;
        let level =
            PathElement::new(vec![(middle - 0.25, median), (middle + 0.25, median)], LIMIT.stroke_width(2 * FINE));
        chart.draw_series([level]).map_err(|e| e.to_string())?;
        let (x, _) = chart.backend_coord(&(middle, median));
        let style = text(12).pos(plotters::style::text_anchor::Pos::new(
            plotters::style::text_anchor::HPos::Center,
            plotters::style::text_anchor::VPos::Center,
        ));
        // Every second label a line lower, so that neighbours keep clear.
        let row = 300 - 28 + 15 * (k as i32 % 2);
        area.draw(&Text::new(one.label.clone(), (x, row * FINE as i32), style)).map_err(|e| e.to_string())?;
    }
    Ok(())
}

/// Cells a side of a map.
const CELLS: usize = 72;

/// A map of a value over a square of the ground (centre and half a side, m), dark where it is small: 0 is darkest, 1 and
/// more white. `marks` are a cross, a ring and a triangle.
///
/// # Errors
/// [`ReportError::Plot`] if the plotter fails.
pub fn draw_map(
    title: &str,
    (center_m, half_m): ((f64, f64), f64),
    value: impl Fn(f64, f64) -> f64,
    marks: &[(f64, f64); 3],
) -> Result<String, ReportError> {
    let mut svg = String::new();
    let drawn = draw_map_into(&mut svg, (center_m, half_m), value, marks);
    drawn.map_err(|problem| ReportError::Plot { title: title.into(), problem })?;
    Ok(accessible(&svg, title))
}

fn draw_map_into(
    svg: &mut String,
    ((x_m, y_m), half_m): ((f64, f64), f64),
    value: impl Fn(f64, f64) -> f64,
    marks: &[(f64, f64); 3],
) -> Result<(), String> {
    let area = SVGBackend::with_string(svg, (WIDTH * FINE, 520 * FINE)).into_drawing_area();
    let mut builder = ChartBuilder::on(&area);
    builder.margin_top(10 * FINE).margin_left(150 * FINE).margin_right(150 * FINE);
    builder.y_label_area_size(70 * FINE).x_label_area_size(44 * FINE);
    let (across, up) = (Axis::linear(x_m - half_m, x_m + half_m, 5), Axis::linear(y_m - half_m, y_m + half_m, 5));
    let mut chart = builder.build_cartesian_2d(across, up).map_err(|e| e.to_string())?;
    let step_m = 2.0 * half_m / CELLS as f64;
    let cells = (0..CELLS * CELLS).map(|k| {
        let corner = (x_m - half_m + (k % CELLS) as f64 * step_m, y_m - half_m + (k / CELLS) as f64 * step_m);
        let share = value(corner.0 + 0.5 * step_m, corner.1 + 0.5 * step_m).clamp(0.0, 1.0);
        let shade = |dark: u8| (f64::from(dark) + (255.0 - f64::from(dark)) * share.sqrt()) as u8;
        let color = RGBColor(shade(LINE.0), shade(LINE.1), shade(LINE.2));
        // A little larger than its place, so that no seam shows between neighbours.
        Rectangle::new([corner, (corner.0 + 1.08 * step_m, corner.1 + 1.08 * step_m)], color.filled())
    });
    chart.draw_series(cells).map_err(|e| e.to_string())?;
    let mut mesh = chart.configure_mesh();
    mesh.disable_mesh().axis_style(FRAME.stroke_width(FINE)).label_style(text(12)).axis_desc_style(text(12));
    mesh.x_desc("x (m)").y_desc("y (m)").draw().map_err(|e| e.to_string())?;
    let inside = |p: &(f64, f64)| (p.0 - x_m).abs() < half_m && (p.1 - y_m).abs() < half_m;
    let thick = LIMIT.stroke_width(2 * FINE);
    if inside(&marks[0]) {
        chart.draw_series([Cross::new(marks[0], 7 * FINE, thick)]).map_err(|e| e.to_string())?;
    }
    if inside(&marks[1]) {
        chart.draw_series([Circle::new(marks[1], 6 * FINE, thick)]).map_err(|e| e.to_string())?;
    }
    if inside(&marks[2]) {
        chart.draw_series([TriangleMarker::new(marks[2], 7 * FINE, thick)]).map_err(|e| e.to_string())?;
    }
    Ok(())
}
