//! What exists, on the CPU in f64: scenario, terrain, bodies, motion, IMU.
//!
//! A [`Scenario`] is read from a TOML file and builds a [`Scene`]: a [`DescentScene`] (ground, a lander on its path,
//! inertial measurements), a [`TumblingScene`] (a small body and its motion) or an [`AttachmentScene`] (linked spacecraft
//! above a site of a small body). Each lists the [`View`]s to take an image of and carries its exact truth. Every setting
//! has a documented default, its unit in its name, and one `validate()`; unknown keys are refused. `datasets/REFERENCE.md`
//! lists them all, made from the types' documentation ([`Scenario::schema`]).

mod attachment;
mod body;
mod camera;
mod descent;
mod elevation;
mod error;
mod ideal;
mod light;
mod noise;
pub mod photometry;
mod scenario;
mod sensor;
mod stars;
mod survey;
mod terrain;
mod tumbling;
mod view;

pub use attachment::{
    ApolloGuidance, ApproachConfig, AttachmentConfig, AttachmentNode, AttachmentScene, BodyConfig, FlexConfig,
    NodeErrorConfig, NodeImuConfig, NodeMotion, Sinusoids, TurningBody,
};
pub use body::{
    AlbedoImage, AlbedoMapFile, BodySource, BodySurface, GlobeMap, ImageEdge, LengthUnit, MassProperties, Mesh,
    MeshAlbedo, MeshFile, ProceduralBody, SmallBody, SurfaceConfig,
};
pub use camera::{CameraConfig, DistortionConfig, DistortionModel, Imager, ImagerConfig, SceneCamera};
pub use descent::{
    CameraMountConfig, DescentConfig, DescentMotion, DescentScene, FrameSchedule, GuidanceConfig, GuidanceProfile,
    ImuConfig, InitialErrorConfig, PolynomialGuidance, SunConfig,
};
pub use elevation::{
    AlbedoValues, ElevationConfig, ElevationModel, ElevationSummary, Georeference, MapPlace, MapSite, Orthoimage,
    OrthoimageConfig, Raster, RasterFile, RasterGeometry, RawLayout, SampleKind,
};
pub use error::SceneError;
pub use ideal::optical_flow;
pub use ideal::{DepthImage, SensedMotion, ideal_samples, observe_landmarks};
pub use light::{EphemerisConfig, SunInIcrf, Sunlight, sun_angular_radius_rad};
pub use noise::{
    NOISE_2D_RMS, NOISE_2D_SLOPE_RMS, NOISE_3D_RMS, NOISE_3D_TANGENT_SLOPE_RMS, NoiseOctave, NoiseSample,
    OctaveStrength, noise_2d, noise_3d,
};
pub use photometry::{
    HapkeParameters, LunarWeight, PhotometricAngles, Photometry, chandrasekhar_h, oren_nayar_coefficients,
};
pub use scenario::{Mission, RenderConfig, Scenario, Scene, TruthConfig};
pub use sensor::{Exposure, FixedPatternConfig, SensorConfig, ShutterConfig, VignettingConfig};
pub use stars::{Sky, SkyConfig, Star};
pub use survey::SurveyLevel;
pub use terrain::{
    CraterClass, Feature, FeatureSample, GroundBase, GroundDetail, GroundSample, HummockClass, RippleClass, Rock,
    RockClass, Scatter, Terrain, TerrainConfig, TerrainPatch, UnitClass, rock_density_1_m2,
};
pub use tumbling::{InertiaSource, PhaseConfig, RigidBody, Spin, TumblingConfig, TumblingScene};
pub use view::View;
