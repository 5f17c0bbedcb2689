//! The camera of a scenario and what it images.

mod config;
mod imager;

pub use config::{CameraConfig, DistortionConfig, DistortionModel};
pub use imager::{Imager, ImagerConfig, SceneCamera};
