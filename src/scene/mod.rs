//! What exists, on the CPU in f64: scenario, terrain, bodies, motion, IMU.

mod crater;
mod mesh;
mod noise;
mod noise_octave;
mod sensor_config;
mod small_body;
mod terrain;
mod terrain_config;
mod terrain_patch;
mod terrain_ray;
mod terrain_rock;
mod terrain_scatter;
mod view;

pub use crater::{CraterClass, FeatureSample};
pub use mesh::Mesh;
pub use noise::{
    NOISE_2D_RMS, NOISE_2D_SLOPE_RMS, NOISE_3D_RMS, NOISE_3D_TANGENT_SLOPE_RMS, NoiseSample, noise_2d, noise_3d,
};
pub use noise_octave::{NoiseOctave, OctaveStrength};
pub use sensor_config::{Exposure, SensorConfig};
pub use small_body::{BodySurface, SmallBody};
pub use terrain::{GroundDetail, GroundSample, Terrain};
pub use terrain_config::{TerrainConfig, TerrainConfigError};
pub use terrain_patch::TerrainPatch;
pub use terrain_rock::RockClass;
pub use terrain_scatter::{Feature, Scatter};
pub use view::View;
