//! Files of other tools, read and written: trajectories of the TUM benchmark (`tum`, also the form of our own attitude
//! chains) and text models of COLMAP (`colmap`). A new tool gets a file or folder here; nothing in it knows a mission.

mod colmap;
mod tum;

pub use colmap::{ColmapImage, ColmapModel, ColmapPoint, read_colmap, write_colmap};
pub use tum::{StampedPose, read_tum, write_tum};
