//! The page that people read: one self-contained HTML file with tables, images and plots.
//!
//! A [`Page`] is plain data, made of [`Section`]s and [`Block`]s; [`write_report`] turns it into a file that needs no
//! network, no script and no font. [`mission_section`] builds the section of a landing, tumbling or tracking result from
//! its [`Metrics`](crate::evaluation::Metrics), and [`result_section`] from its folder.
//! [`scenario_reference`] lists the keys of a scenario in Markdown, [`settings_reference`] the settings of commands.

#[cfg(feature = "report")]
mod error;
mod figure_lines;
mod numbers;
#[cfg(feature = "report")]
mod page;
#[cfg(feature = "report")]
mod plot;
mod reference;
#[cfg(feature = "vision")]
mod track_overlay;

#[cfg(feature = "report")]
pub use error::ReportError;
pub use figure_lines::figure_lines;
pub use numbers::{format_number, label_of, unit_label};
#[cfg(all(feature = "report", feature = "scene"))]
pub use page::campaign_sections;
#[cfg(feature = "report")]
pub use page::{
    Block, MissionReport, Page, PageImage, Section, environment_table, figure_table, image_png, mission_section,
    render_page, result_section, timing_table, write_report,
};
#[cfg(feature = "report")]
pub use plot::{Curve, LegendEntry, Plot, consistency_plot, error_with_envelope, magnitude_plot};
pub use reference::{CommandSettings, scenario_reference, settings_reference};
#[cfg(feature = "vision")]
pub use track_overlay::{contact_sheet, draw_tracks};
