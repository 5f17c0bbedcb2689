//! COLMAP's text model: `cameras.txt`, `images.txt`, `points3D.txt` (colmap.github.io/format.html).
//!
//! COLMAP puts the centre of the top-left pixel at (0.5, 0.5), half a pixel from ours, and stores the pose that takes the
//! reference frame to the camera. Numbers of cameras and images start at 1.

mod model;
mod read;
mod write;

pub use model::{ColmapImage, ColmapModel, ColmapPoint};
pub use read::read_colmap;
pub use write::write_colmap;

/// COLMAP's pixel less ours.
const HALF_PIXEL_PX: f64 = 0.5;
