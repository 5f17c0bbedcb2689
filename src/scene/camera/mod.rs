//! The camera of a scenario: its table (`config`: size, field of view or focal lengths, lens) and, with its detector
//! and name, what images (`imager`). Every mission's scene holds a list of these with the views that they take.

mod config;
mod imager;

pub use config::{CameraConfig, DistortionConfig, DistortionModel};
pub use imager::{Imager, ImagerConfig, SceneCamera};
