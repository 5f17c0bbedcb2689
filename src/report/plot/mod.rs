//! Plots: axes, charts, kinds. What only campaigns draw needs the feature `scene`.

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
