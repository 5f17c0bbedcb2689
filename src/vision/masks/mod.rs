//! Where not to look: parts of the spacecraft, the sky beside a body's silhouette.

mod mask;
mod silhouette;

pub use mask::KeepOut;
pub use silhouette::{bright_centroid_px, inside_silhouette};
