//! Filters that run from image to image: the paper's, and the one for real time.

mod paper_filter;
mod realtime;

pub use paper_filter::{PaperFilter, PaperState, chained_attitudes};
pub use realtime::filter_after_first_arc;
