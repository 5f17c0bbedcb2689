//! The self-contained page: missions, figures, pictures, campaigns.

#[cfg(feature = "scene")]
mod campaign;
mod figures;
mod mission;
mod page;
mod picture;
mod render;
mod result;

#[cfg(feature = "scene")]
pub use campaign::campaign_sections;
pub use figures::{environment_table, figure_table, timing_table};
pub use mission::{MissionReport, mission_section};
pub use page::{Block, Page, Picture, Section};
pub use picture::picture_png;
pub use render::{render_page, write_report};
pub use result::result_section;
