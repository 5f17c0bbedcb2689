//! Plots as SVG text: `axis` places ticks, `plot` is the panel with its layers, `kinds` the plots of a mission (errors
//! in their envelopes, consistency, sizes), `charts` boxes and maps, which only campaigns draw (feature `scene`). The
//! page uses it.

mod axis;
#[cfg(feature = "scene")]
mod charts;
mod kinds;
mod plot;

#[cfg(feature = "scene")]
pub use axis::Axis;
#[cfg(feature = "scene")]
pub use charts::{Box, draw_boxes, draw_map};
pub use kinds::{Curve, consistency_plot, error_with_envelope, magnitude_plot};
#[cfg(feature = "scene")]
pub use plot::{BAND, LIMIT, LINE, Layer, Panel, draw_panels};
pub use plot::{LegendEntry, Plot};
