//! The section of one result, built from its metrics.

use super::figures::{figure_table, figures_with, timing_table};
use super::page::{Block, PageImage, Section};
use crate::evaluation::{Metrics, Mission, Series};
use crate::report::error::ReportError;
use crate::report::numbers::format_number;
use crate::report::plot::{Curve, consistency_plot, error_with_envelope, magnitude_plot};
use serde_json::Value;

/// What the section of a result is built from.
#[derive(Debug, Clone)]
pub struct MissionReport<'a> {
    /// Heading of the section.
    pub heading: String,
    /// What was done, in a few sentences.
    pub done: String,
    /// Sample frames with features drawn in.
    pub images: Vec<PageImage>,
    /// Errors, consistency, verdicts.
    pub metrics: &'a Metrics,
    /// The result's `summary.json`, for its timing; [`Value::Null`] if there is none.
    pub summary: &'a Value,
}

/// Section of a landing, tumbling or tracking result.
///
/// # Errors
/// [`ReportError::Plot`] if a plot cannot be drawn.
pub fn mission_section(report: &MissionReport<'_>) -> Result<Section, ReportError> {
    let metrics = report.metrics;
    let mut blocks = vec![Block::Paragraph(report.done.clone())];
    if !metrics.verdicts.is_empty() {
        blocks.push(Block::Verdicts(metrics.verdicts.clone()));
    }
    if !report.images.is_empty() {
        blocks.push(Block::Gallery(report.images.clone()));
    }
    match metrics.mission {
        Mission::Landing => add_landing(metrics, &mut blocks)?,
        Mission::Tumbling => add_tumbling(metrics, &mut blocks)?,
        Mission::Tracking => {}
    }
    add_front_end(metrics, &mut blocks)?;
    blocks.extend(timing_table(report.summary));
    if !metrics.notes.is_empty() {
        blocks.push(Block::Notes(metrics.notes.clone()));
    }
    Ok(Section { heading: report.heading.clone(), blocks })
}

fn add_landing(metrics: &Metrics, blocks: &mut Vec<Block>) -> Result<(), ReportError> {
    blocks.push(Block::Heading("Navigation errors".into()));
    blocks.push(landing_table(metrics));
    let trajectory = figures_with(metrics, &["ate_", "rpe_", "tracked_point_", "nees_"]);
    blocks.push(figure_table("Trajectory and consistency", trajectory));
    let groups = [
        ("Position error in the site frame (x, y level; z up)", "position_error_"),
        ("Velocity error in the site frame", "velocity_error_"),
    ];
    for (title, prefix) in groups {
        add_errors(title, &series_of(metrics, &["x", "y", "z"].map(|a| format!("{prefix}{a}"))), blocks)?;
    }
    let attitude = series_of(metrics, &["roll_error", "pitch_error", "yaw_error"].map(String::from));
    add_errors("Attitude error", &attitude, blocks)?;
    add_consistency(metrics, blocks)
}

/// Errors at the end and at the last image, each against the site's origin and against the tracked ground point.
fn landing_table(metrics: &Metrics) -> Block {
    let columns = [
        ("at the last picture", "last_picture_"),
        ("at the end", "final_"),
        ("at the last picture, from the tracked point", "last_picture_from_tracked_point_"),
        ("at the end, from the tracked point", "final_from_tracked_point_"),
    ];
    let rows = [
        ("Horizontal", "horizontal_error", "m"),
        ("Vertical", "z_error", "m"),
        ("Speed", "speed_error", "m/s"),
        ("Roll", "roll_error", "°"),
        ("Pitch", "pitch_error", "°"),
        ("Yaw", "yaw_error", "°"),
    ];
    let there: Vec<_> =
        columns.into_iter().filter(|(_, p)| metrics.figure(&format!("{p}horizontal_error")).is_some()).collect();
    let cell =
        |prefix: &str, name: &str| metrics.figure(&format!("{prefix}{name}")).map_or(String::new(), format_number);
    let row = |(label, name, unit): (&str, &str, &str)| {
        let mut row = vec![label.to_string(), unit.to_string()];
        row.extend(there.iter().map(|(_, prefix)| cell(prefix, name)));
        row
    };
    let mut header = vec!["error (true − estimated)".to_string(), "unit".into()];
    header.extend(there.iter().map(|(title, _)| title.to_string()));
    Block::Table { caption: "Errors of the landing".into(), header, rows: rows.into_iter().map(row).collect() }
}

fn add_tumbling(metrics: &Metrics, blocks: &mut Vec<Block>) -> Result<(), ReportError> {
    blocks.push(Block::Heading("Attitude, rate and inertia".into()));
    let prefixes = ["final_", "attitude_error", "rate_error", "nees_", "worst_inertia"];
    blocks.push(figure_table("Errors of the motion", figures_with(metrics, &prefixes)));
    blocks.push(inertia_table(metrics));
    for (title, prefix) in
        [("Attitude error in the camera's axes", "attitude_error_"), ("Rate error in asteroid axes", "rate_error_")]
    {
        add_errors(title, &series_of(metrics, &["x", "y", "z"].map(|a| format!("{prefix}{a}"))), blocks)?;
    }
    let inertia = ["Lxx", "Lyy", "Lxy", "Lxz", "Lyz"].map(|name| format!("{name}_error"));
    let curves: Vec<&Series> = series_of(metrics, &inertia).into_iter().filter(|s| s.values.len() > 1).collect();
    add_errors("Error of the inertia ratios", &curves, blocks)?;
    add_consistency(metrics, blocks)
}

fn inertia_table(metrics: &Metrics) -> Block {
    let row = |name: &str| {
        let value = |figure: String| metrics.figure(&figure);
        let truth = value(format!("true_{name}"));
        let error = value(format!("{name}_error"));
        let estimated = truth.zip(error).map(|(t, e)| format_number(t - e)).unwrap_or("not determined".into());
        let cell = |v: Option<f64>| v.map_or(String::new(), format_number);
        vec![name.to_string(), cell(truth), estimated, cell(error), cell(value(format!("{name}_sigma")))]
    };
    let header = ["ratio to Lzz", "true", "estimated", "error", "1σ"].map(String::from).to_vec();
    let rows = ["Lxx", "Lyy", "Lxy", "Lxz", "Lyz"].into_iter().map(row).collect();
    Block::Table { caption: "Inertia ratios in the camera's axes at the start".into(), header, rows }
}

/// Pairs and tracks, which every mission has.
fn add_front_end(metrics: &Metrics, blocks: &mut Vec<Block>) -> Result<(), ReportError> {
    let figures = figures_with(metrics, &["pair", "track_", "tracks_", "tracked_frames"]);
    if figures.is_empty() {
        return Ok(());
    }
    blocks.push(Block::Heading("Image front end".into()));
    blocks.push(figure_table("Pairs and tracks", figures));
    let plots = [
        ("Error of the rotation between pairs of pictures", "pair_rotation_error"),
        ("Median error of the tracks, frame to frame", "track_error_median"),
    ];
    for (title, name) in plots {
        if let Some(series) = metrics.series(name).filter(|s| s.values.len() > 1) {
            blocks.push(Block::Plot(magnitude_plot(title, &series.unit, &curve(series, "error".into()))?));
        }
    }
    Ok(())
}

fn add_errors(title: &str, series: &[&Series], blocks: &mut Vec<Block>) -> Result<(), ReportError> {
    let Some(first) = series.first() else { return Ok(()) };
    let short = |s: &Series| {
        let name = s.name.trim_end_matches("_error");
        name.rsplit('_').next().unwrap_or(name).to_string()
    };
    let curves: Vec<Curve<'_>> = series.iter().map(|s| curve(s, short(s))).collect();
    blocks.push(Block::Plot(error_with_envelope(title, &first.unit, &curves)?));
    Ok(())
}

fn add_consistency(metrics: &Metrics, blocks: &mut Vec<Block>) -> Result<(), ReportError> {
    if let Some((series, bounds)) = metrics.series("nees_per_dof").and_then(|s| Some((s, s.bound?))) {
        let title = "Consistency: normalised error squared per degree of freedom (1 is perfect)";
        blocks.push(Block::Plot(consistency_plot(title, &curve(series, "NEES / dof".into()), &bounds)?));
    }
    Ok(())
}

fn series_of<'a>(metrics: &'a Metrics, names: &[String]) -> Vec<&'a Series> {
    names.iter().filter_map(|name| metrics.series(name)).collect()
}

fn curve(series: &Series, label: String) -> Curve<'_> {
    Curve { label, t_s: &series.t_s, values: &series.values, sigma: &series.sigma }
}
