//! What exists, on the CPU in f64: scenario, terrain, bodies, motion, IMU.
//!
//! A [`Scenario`] is read from a TOML file and builds a [`Scene`]: either a [`DescentScene`] (ground, a lander on its
//! path, inertial measurements) or a [`TumblingScene`] (a small body and its motion). Both list the [`View`]s to take a
//! picture of and carry their exact truth. Every setting has a documented default, its unit in its name, and one
//! `validate()`; unknown keys are refused.

mod body_crater;
mod body_relief;
mod body_shape;
mod body_source;
mod camera_config;
mod descent;
mod error;
mod icosphere;
mod imager;
mod limits;
mod mass_properties;
mod mesh;
mod mesh_landmarks;
mod mesh_topology;
mod obj;
mod scenario;
mod scenario_file;
mod sensor_config;
mod small_body;
mod terrain;
mod tumbling;
mod view;

pub use body_shape::ProceduralBody;
pub use body_source::{BodySource, MeshFile};
pub use camera_config::CameraConfig;
pub use descent::{
    CameraMountConfig, DescentConfig, DescentMotion, DescentScene, FrameSchedule, GuidanceConfig, GuidanceProfile,
    ImuConfig, InitialErrorConfig, PolynomialGuidance, SunConfig, ideal_samples,
};
pub use error::SceneError;
pub use imager::Imager;
pub use mass_properties::MassProperties;
pub use mesh::Mesh;
pub use scenario::{Mission, Scenario, Scene};
pub use sensor_config::{Exposure, SensorConfig};
pub use small_body::{BodySurface, SmallBody, SurfaceConfig};
pub use terrain::{Terrain, TerrainConfig, TerrainConfigError};
pub use tumbling::{InertiaSource, PhaseConfig, RigidBody, Spin, TumblingConfig, TumblingScene};
pub use view::View;
