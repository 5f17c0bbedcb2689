//! What exists, on the CPU in f64: scenario, terrain, bodies, motion, IMU.

mod mesh;
mod sensor_config;
mod small_body;
mod view;

pub use mesh::Mesh;
pub use sensor_config::{Exposure, SensorConfig};
pub use small_body::{BodySurface, SmallBody};
pub use view::View;
