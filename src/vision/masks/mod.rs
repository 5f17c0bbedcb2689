//! Where not to look: parts of the spacecraft (`mask`), and the sky beside a body's silhouette (`silhouette`).
//! Detector, patches and trackers ask here.

mod mask;
mod silhouette;

pub use mask::KeepOut;
pub use silhouette::{bright_centroid_px, inside_silhouette};
