//! The self-contained page. `page` is its plain data, `render` the HTML of it; `result` and `mission` make the section
//! of a result folder, `campaign` those of simulated flights (feature `scene`), `figures` the tables, `image` the PNGs.
//! Nothing else in the crate writes HTML.

#[cfg(feature = "scene")]
mod campaign;
mod figures;
mod image;
mod mission;
mod page;
mod render;
mod result;

#[cfg(feature = "scene")]
pub use campaign::campaign_sections;
pub use figures::{environment_table, figure_table, timing_table};
pub use image::image_png;
pub use mission::{MissionReport, mission_section};
pub use page::{Block, Page, PageImage, Section};
pub use render::{render_page, write_report};
pub use result::result_section;
