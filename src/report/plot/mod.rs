//! Plots: axes, charts, kinds, and how numbers are written.

mod axis;
mod charts;
mod kinds;
mod numbers;
mod plot;

pub use axis::Axis;
pub use charts::{Box, draw_boxes, draw_map};
pub use kinds::{Curve, consistency_plot, error_with_envelope, magnitude_plot};
pub use numbers::{format_number, label_of, unit_label};
pub use plot::{BAND, LIMIT, LINE, Layer, LegendEntry, Panel, Plot, draw_panels};
