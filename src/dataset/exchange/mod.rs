//! Files of other tools: trajectories of TUM, models of COLMAP.

mod colmap;
mod tum;

pub use colmap::{ColmapImage, ColmapModel, ColmapPoint, read_colmap, write_colmap};
pub use tum::{StampedPose, read_tum, write_tum};
