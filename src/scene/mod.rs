//! What exists, on the CPU in f64: scenario, terrain, bodies, motion, IMU.
//!
//! A [`Scenario`] is read from a TOML file and builds a [`Scene`]: a [`DescentScene`] (ground, a lander on its path,
//! inertial measurements), a [`TumblingScene`] (a small body and its motion) or an [`AttachmentScene`] (linked spacecraft
//! above a site of a small body). Each lists the [`View`]s to take a picture of and carries its exact truth. Every setting
//! has a documented default, its unit in its name, and one `validate()`; unknown keys are refused. `datasets/REFERENCE.md`
//! lists them all, made from the types' documentation ([`Scenario::schema`]).

mod attachment;
mod body;
mod camera_config;
mod crater;
mod depth_picture;
mod descent;
mod elevation;
mod error;
mod imager;
mod light;
mod limits;
mod mission_scene;
mod noise;
mod noise_octave;
mod noise_table;
mod octave_sums;
mod optical_flow;
pub mod photometry;
mod render_config;
mod scenario;
mod scenario_file;
mod sensed_motion;
mod sensor;
mod stars;
mod survey;
mod terrain;
mod terrain_base;
mod terrain_bins;
mod terrain_config;
mod terrain_features;
mod terrain_hummock;
mod terrain_patch;
mod terrain_ray;
mod terrain_ripple;
mod terrain_rock;
mod terrain_scatter;
mod terrain_site;
mod terrain_sizes;
mod terrain_softened;
mod terrain_unit;
mod truth_config;
mod tumbling;
mod view;

pub use attachment::{
    ApolloGuidance, ApproachConfig, AttachmentConfig, AttachmentNode, AttachmentScene, BodyConfig, FlexConfig,
    NodeErrorConfig, NodeImuConfig, NodeMotion, Sinusoids, TurningBody,
};
pub use body::{
    AlbedoImage, AlbedoMapFile, BodySource, BodySurface, GlobeMap, LengthUnit, MassProperties, Mesh, MeshAlbedo,
    MeshFile, PictureEdge, ProceduralBody, SmallBody, SurfaceConfig,
};
pub use camera_config::{CameraConfig, DistortionConfig, DistortionModel};
pub use crater::{CraterClass, FeatureSample};
pub use depth_picture::{DepthPicture, observe_landmarks};
pub use descent::{
    CameraMountConfig, DescentConfig, DescentMotion, DescentScene, FrameSchedule, GuidanceConfig, GuidanceProfile,
    ImuConfig, InitialErrorConfig, PolynomialGuidance, SunConfig,
};
pub use elevation::{
    AlbedoValues, ElevationConfig, ElevationModel, ElevationSummary, Georeference, GroundBase, MapPlace, MapSite,
    Orthoimage, OrthoimageConfig, Raster, RasterFile, RasterGeometry, RawLayout, SampleKind,
};
pub use error::SceneError;
pub use imager::{Imager, ImagerConfig, SceneCamera};
pub use light::{EphemerisConfig, SunInIcrf, Sunlight, sun_angular_radius_rad};
pub use mission_scene::{Mission, Scene};
pub use noise::{
    NOISE_2D_RMS, NOISE_2D_SLOPE_RMS, NOISE_3D_RMS, NOISE_3D_TANGENT_SLOPE_RMS, NoiseSample, noise_2d, noise_3d,
};
pub use noise_octave::{NoiseOctave, OctaveStrength};
pub use optical_flow::optical_flow;
pub use photometry::{
    HapkeParameters, LunarWeight, PhotometricAngles, Photometry, chandrasekhar_h, oren_nayar_coefficients,
};
pub use render_config::RenderConfig;
pub use scenario::Scenario;
pub use sensed_motion::{SensedMotion, ideal_samples};
pub use sensor::{Exposure, FixedPatternConfig, SensorConfig, ShutterConfig, VignettingConfig};
pub use stars::{Sky, SkyConfig, Star};
pub use survey::SurveyLevel;
pub use terrain::{GroundDetail, GroundSample, Terrain};
pub use terrain_config::{TerrainConfig, TerrainConfigError};
pub use terrain_hummock::HummockClass;
pub use terrain_patch::TerrainPatch;
pub use terrain_ripple::RippleClass;
pub use terrain_rock::{Rock, RockClass, rock_density_1_m2};
pub use terrain_scatter::{Feature, Scatter};
pub use terrain_unit::UnitClass;
pub use truth_config::TruthConfig;
pub use tumbling::{InertiaSource, PhaseConfig, RigidBody, Spin, TumblingConfig, TumblingScene};
pub use view::View;
