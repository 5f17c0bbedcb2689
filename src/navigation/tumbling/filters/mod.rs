//! Estimators that go from image to image: `paper_filter`, the baseline as published with its faults, and `realtime`, a
//! cloned Kalman filter that starts from a fit of the first arc. Both use `motion` and are chosen in `estimate`; a
//! further one is a file here.

mod paper_filter;
mod realtime;

pub use paper_filter::{PaperFilter, PaperState, chained_attitudes};
pub use realtime::filter_after_first_arc;
