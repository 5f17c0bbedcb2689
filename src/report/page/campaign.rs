//! The sections of a campaign of simulated landings: the path, where a landmark tells most, errors in their envelopes,
//! consistency, and what each choice of a landmark costs.

use super::page::{Block, Section};
use crate::campaign::{Campaign, TrueState, true_states};
use crate::evaluation::percentile;
use crate::navigation::landmark::{GroundPrior, Triangle, Viewpoint};
use crate::report::error::ReportError;
use crate::report::numbers::format_number;
use crate::report::plot::{
    Axis, BAND, Box, Curve, LIMIT, LINE, Layer, LegendEntry, Panel, Plot, consistency_plot, draw_boxes, draw_map,
    draw_panels,
};
use crate::stats::ConsistencyBounds;
use nalgebra::{SMatrix, Vector3};
use plotters::style::RGBColor;

/// Flights that are drawn one by one.
const DRAWN_FLIGHTS: usize = 25;

/// The sections of campaigns that differ by their selector.
///
/// # Errors
/// [`ReportError::Plot`] if a plot cannot be drawn.
pub fn campaign_sections(campaigns: &[Campaign]) -> Result<Vec<Section>, ReportError> {
    let Some(first) = campaigns.first() else { return Ok(Vec::new()) };
    let states = true_states(&first.options);
    let mut sections = vec![
        Section { heading: "Errors at touchdown".into(), blocks: vec![final_table(campaigns)] },
        Section { heading: "True states".into(), blocks: path_plots(&states)?.into_iter().map(Block::Plot).collect() },
        Section { heading: "Where a landmark tells most".into(), blocks: depth_error_blocks(&states)? },
    ];
    for campaign in campaigns {
        let heading = format!("Selector {}", campaign.options.filter.selector.word());
        sections.push(Section { heading, blocks: error_blocks(campaign)? });
    }
    sections.push(Section { heading: "Time per choice".into(), blocks: vec![Block::Plot(time_plot(campaigns)?)] });
    Ok(sections)
}

fn final_table(campaigns: &[Campaign]) -> Block {
    let header = [
        "selector",
        "converged",
        "horizontal (m)",
        "z (m)",
        "z by the filter (m)",
        "velocity (m/s)",
        "roll (°)",
        "pitch (°)",
        "NEES / 9",
    ];
    let row = |campaign: &Campaign| {
        let e = campaign.final_errors();
        let numbers = [e.horizontal_m, e.z_m, e.z_believed_m, e.velocity_m_s, e.roll_deg, e.pitch_deg, e.nees];
        let mut row =
            vec![campaign.options.filter.selector.word().to_string(), format!("{} of {}", e.converged, e.runs)];
        row.extend(numbers.map(format_number));
        row
    };
    Block::Table {
        caption: "3 r.m.s. over all flights, an axis; NEES / 9 is the mean over 30 to 182 s".into(),
        header: header.map(String::from).to_vec(),
        rows: campaigns.iter().map(row).collect(),
    }
}

fn path_plots(states: &[TrueState]) -> Result<Vec<Plot>, ReportError> {
    let position = |k: usize| move |s: &TrueState| s.position_m[k];
    let velocity = |k: usize| move |s: &TrueState| s.velocity_m_s[k];
    let angle = |s: &TrueState| s.lander_from_site.inverse().euler_angles();
    let roll = move |s: &TrueState| angle(s).0.to_degrees();
    let pitch = move |s: &TrueState| angle(s).1.to_degrees();
    let positions =
        ["x (m)", "y (m)", "z (m)"].into_iter().enumerate().map(|(k, l)| path_panel(l, states, position(k)));
    let velocities =
        ["vx (m/s)", "vy (m/s)", "vz (m/s)"].into_iter().enumerate().map(|(k, l)| path_panel(l, states, velocity(k)));
    let attitudes = [path_panel("roll (°)", states, roll), path_panel("pitch (°)", states, pitch)];
    let time = Axis::linear(0.0, (states.len() - 1) as f64, 9);
    let plot = |title: &str, panels: Vec<Panel>| {
        let svg = draw_panels(title, &time, &panels, 110)?;
        Ok::<_, ReportError>(Plot { title: title.into(), svg, legend: Vec::new() })
    };
    Ok(vec![
        plot("Position in the site frame", positions.collect())?,
        plot("Velocity in the site frame", velocities.collect())?,
        plot("Attitude", attitudes.into())?,
    ])
}

fn path_panel(label: &str, states: &[TrueState], value: impl Fn(&TrueState) -> f64) -> Panel {
    let points: Vec<(f64, f64)> = states.iter().enumerate().map(|(t, s)| (t as f64, value(s))).collect();
    let (low, high) = points.iter().fold((0.0f64, 0.0f64), |(low, high), (_, v)| (low.min(*v), high.max(*v)));
    let margin = 0.05 * (high - low);
    let layers = vec![Layer::Level(0.0, RGBColor(150, 158, 168)), Layer::Line(points, LINE)];
    Panel { label: label.into(), axis: Axis::linear(low - margin, high + margin, 4), layers }
}

/// Depth error over the place of a landmark at three times.
fn depth_error_blocks(states: &[TrueState]) -> Result<Vec<Block>, ReportError> {
    let mut blocks = vec![Block::Paragraph(
        "The depth error δr of a landmark at each place of the ground, over the least one, at three times; dark tells \
         most. The cross is the closed-form optimum, the ring the ground below the lander, the triangle the site."
            .into(),
    )];
    for second in [0, 60, 120] {
        let Some(state) = states.get(second) else { continue };
        let view = viewpoint(state);
        let Some(triangle) = Triangle::of(&view) else { continue };
        let (alpha_rad, beta_rad) = triangle.minimum();
        let best_m = triangle.landmark_in_site_m(&view, alpha_rad, beta_rad);
        let least = triangle.depth_error(alpha_rad, beta_rad);
        let value = |x_m: f64, y_m: f64| {
            let (alpha_rad, beta_rad) = triangle_angles(&view, &triangle, &Vector3::new(x_m, y_m, 0.0));
            (triangle.depth_error(alpha_rad, beta_rad) / least).log10()
        };
        let half_m = 2.0 * state.position_m.z;
        let center_m = (state.position_m.x, state.position_m.y);
        let title = format!("Depth error at {second} s (logarithm of the ratio to the least)");
        let marks = [(best_m.x, best_m.y), center_m, (0.0, 0.0)];
        let svg = draw_map(&title, (center_m, half_m), value, &marks)?;
        blocks.push(Block::Plot(Plot { title, svg, legend: Vec::new() }));
    }
    Ok(blocks)
}

fn viewpoint(state: &TrueState) -> Viewpoint {
    Viewpoint {
        lander_in_site_m: state.position_m,
        lander_velocity_in_site_m_s: state.velocity_m_s,
        specific_force_in_site_m_s2: Vector3::zeros(),
        gravity_in_site_m_s2: Vector3::zeros(),
        interval_s: 1.0,
        sigma_bearing_rad: 1e-3,
        covariance: SMatrix::identity(),
        ground: GroundPrior::default(),
    }
}

/// (α, β) of a ground point: at D, where the path meets the ground, between the path and the point; and at the lander.
fn triangle_angles(view: &Viewpoint, triangle: &Triangle, point_m: &Vector3<f64>) -> (f64, f64) {
    let velocity = view.lander_velocity_in_site_m_s.normalize();
    let end_m = view.lander_in_site_m + velocity * triangle.range_to_ground_m;
    let beta_rad = (point_m - view.lander_in_site_m).angle(&velocity).max(1e-3);
    let alpha_rad = (point_m - end_m).angle(&-velocity);
    (alpha_rad.min(std::f64::consts::PI - beta_rad - 1e-3), beta_rad)
}

/// Single flights, 3σ of the filter and 3σ of the bound, and consistency.
fn error_blocks(campaign: &Campaign) -> Result<Vec<Block>, ReportError> {
    let groups = [
        ("Position error", "m", [0, 1, 2], ["x", "y", "z"], 1.0),
        ("Velocity error", "m/s", [3, 4, 5], ["x", "y", "z"], 1.0),
        ("Attitude error", "°", [6, 7, 8], ["roll", "pitch", "yaw"], 1f64.to_degrees()),
    ];
    let mut blocks = Vec::new();
    for (title, unit, components, names, scale) in groups {
        let panels: Vec<Panel> = components
            .iter()
            .zip(names)
            .map(|(c, name)| error_panel(campaign, *c, &format!("{name} ({unit})"), scale))
            .collect();
        let time = Axis::linear(0.0, campaign.seconds().saturating_sub(1) as f64, 9);
        let svg = draw_panels(title, &time, &panels, 132)?;
        let legend = vec![
            entry(LINE, &format!("error of the first {} flights", DRAWN_FLIGHTS.min(campaign.flights.len()))),
            entry(BAND, "±3σ of the filter"),
            entry(LIMIT, "±3σ of the posterior Cramér–Rao bound"),
        ];
        blocks.push(Block::Plot(Plot { title: title.into(), svg, legend }));
    }
    let seconds: Vec<f64> = (0..campaign.seconds()).map(|t| t as f64).collect();
    let nees: Vec<f64> = (0..campaign.seconds()).map(|t| campaign.nees(t)).collect();
    let curve = Curve { label: "NEES / 9".into(), t_s: &seconds, values: &nees, sigma: &[] };
    let bounds = ConsistencyBounds::of_mean(9, campaign.flights.len(), 0.95);
    let title = "Consistency: mean over the flights of the normalised error squared (1 is perfect)";
    let mut plot = consistency_plot(title, &curve, &bounds)?;
    plot.legend[1].label = "95 % χ² bounds of the mean".into();
    blocks.push(Block::Plot(plot));
    Ok(blocks)
}

fn error_panel(campaign: &Campaign, component: usize, label: &str, scale: f64) -> Panel {
    let seconds = campaign.seconds();
    let curve = |value: &dyn Fn(usize) -> f64| -> Vec<(f64, f64)> {
        (0..seconds).map(|t| (t as f64, value(t) * scale)).filter(|(_, v)| v.is_finite()).collect()
    };
    let envelope = curve(&|t| 3.0 * campaign.believed(t, component));
    let sizes: Vec<f64> = envelope.iter().map(|(_, v)| *v).collect();
    let mut layers = vec![Layer::Band(envelope), Layer::Level(0.0, RGBColor(150, 158, 168))];
    for flight in campaign.flights.iter().take(DRAWN_FLIGHTS) {
        let points = flight.epochs.iter().enumerate().map(|(t, e)| (t as f64, e.error[component] * scale));
        layers.push(Layer::Line(points.collect(), RGBColor(98, 134, 168)));
    }
    layers.push(Layer::Line(curve(&|t| 3.0 * campaign.bound(t, component)), LIMIT));
    layers.push(Layer::Line(curve(&|t| -3.0 * campaign.bound(t, component)), LIMIT));
    Panel { label: label.into(), axis: Axis::for_errors(&sizes), layers }
}

/// Time of each choice: quartiles, and whiskers from 5 to 95 %.
fn time_plot(campaigns: &[Campaign]) -> Result<Plot, ReportError> {
    let boxes: Vec<Box> = campaigns
        .iter()
        .filter_map(|campaign| {
            let times: Vec<f64> =
                campaign.flights.iter().flat_map(|f| f.selection_ns.iter().map(|ns| ns * 1e-3)).collect();
            let at = |share: f64| percentile(&times, share);
            let values = [at(0.05)?, at(0.25)?, at(0.5)?, at(0.75)?, at(0.95)?];
            Some(Box { label: campaign.options.filter.selector.word().into(), values })
        })
        .collect();
    let title = "Time per choice of a landmark: quartiles, whiskers from 5 to 95 %";
    let svg = draw_boxes(title, "time (µs)", &boxes)?;
    Ok(Plot { title: title.into(), svg, legend: Vec::new() })
}

fn entry(color: RGBColor, label: &str) -> LegendEntry {
    LegendEntry { color: format!("rgb({}, {}, {})", color.0, color.1, color.2), label: label.into() }
}
