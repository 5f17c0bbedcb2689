//! The page that people read: one self-contained HTML file with tables, pictures and plots.
//!
//! A [`Page`] is plain data, made of [`Section`]s and [`Block`]s; [`write_report`] turns it into a file that needs no
//! network, no script and no font. [`mission_section`] builds the section of a landing, tumbling or tracking result from
//! its [`Metrics`](crate::evaluation::Metrics), and [`result_section`] from its folder.
//! [`scenario_reference`] lists the keys of a scenario in Markdown, [`settings_reference`] the settings of commands.

mod error;
mod page;
mod plot;
mod reference;
mod track_overlay;

pub use error::ReportError;
pub use page::{
    Block, MissionReport, Page, Picture, Section, campaign_sections, environment_table, figure_lines, figure_table,
    mission_section, picture_png, render_page, result_section, timing_table, write_report,
};
pub use plot::{
    Curve, LegendEntry, Plot, consistency_plot, error_with_envelope, format_number, label_of, magnitude_plot,
    unit_label,
};
pub use reference::{CommandSettings, scenario_reference, settings_reference};
pub use track_overlay::{contact_sheet, draw_tracks};
