//! Where truth meets estimate, and nowhere else: errors, consistency, verdicts.
//!
//! [`evaluate`] reads a result folder and the truth of the data set that it came from, writes `metrics.json` and
//! `metrics_series.json` into the result, and returns both as [`Metrics`]. Errors are always *true minus estimated*, in
//! the frames that each figure's description names; normalised errors are judged by χ² bounds.

mod consistency;
mod error;
mod evaluate;
mod ground;
#[cfg(feature = "scene")]
mod image;
mod landing;
mod landing_end;
mod landing_epochs;
mod landing_errors;
mod metrics;
mod named_table;
mod pairs;
mod spread;
mod summary;
mod tracks;
mod true_camera;
mod true_motion;
mod tumbling;
mod tumbling_epochs;

pub use consistency::{Consistency, NormalizedSample, effective_samples};
pub use error::EvaluationError;
pub use evaluate::evaluate;
#[cfg(feature = "scene")]
pub use image::ImageStatistics;
pub use metrics::{Figure, Metrics, Series, Verdict};
pub use named_table::NamedTable;
pub use spread::{median, percentile, root_mean_square};
pub use summary::{Mission, Summary};
pub use true_motion::{asteroid_state_at, lander_state_at};
