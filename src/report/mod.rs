//! The page that people read: one self-contained HTML file with tables, pictures and plots.
//!
//! A [`Page`] is plain data, made of [`Section`]s and [`Block`]s; [`write_report`] turns it into a file that needs no
//! network, no script and no font. [`mission_section`] builds the section of a landing, tumbling or tracking result from
//! its [`Metrics`](crate::evaluation::Metrics), and [`result_section`] from its folder.
//! [`scenario_reference`] lists the keys of a scenario in Markdown.

mod axis;
mod campaign;
mod charts;
mod error;
mod figures;
mod mission;
mod numbers;
mod page;
mod picture;
mod plot;
mod plot_kinds;
mod reference;
mod reference_text;
mod render;
mod result;

pub use campaign::campaign_sections;
pub use error::ReportError;
pub use figures::{environment_table, figure_lines, figure_table, timing_table};
pub use mission::{MissionReport, mission_section};
pub use numbers::{format_number, label_of, unit_label};
pub use page::{Block, Page, Picture, Section};
pub use picture::picture_png;
pub use plot::{LegendEntry, Plot};
pub use plot_kinds::{Curve, consistency_plot, error_with_envelope, magnitude_plot};
pub use reference::scenario_reference;
pub use render::{render_page, write_report};
pub use result::result_section;
