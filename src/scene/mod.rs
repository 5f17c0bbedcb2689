//! What exists, on the CPU in f64: scenario, terrain, bodies, motion, IMU.

mod mesh;
mod view;

pub use mesh::Mesh;
pub use view::View;
