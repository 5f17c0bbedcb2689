//! Scenario files: TOML with defaults, overrides, and errors that name file and key.

use super::mission::Mission;
use super::render_config::RenderConfig;
use super::scenario::Scenario;
use super::truth_config::TruthConfig;
use crate::scene::attachment::AttachmentConfig;
use crate::scene::camera::{CameraConfig, DistortionConfig, ImagerConfig};
use crate::scene::descent::DescentConfig;
use crate::scene::error::SceneError;
use crate::scene::sensor::SensorConfig;
use crate::scene::survey::SurveyConfig;
use crate::scene::tumbling::TumblingConfig;
use crate::settings::{Layers, SettingsError, SettingsFile};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::Path;

const DESCENT_FOV_DEG: f64 = 90.0;
const BODY_FOV_DEG: f64 = 30.0;

/// A scenario as it stands in a file. It has one of the tables `[descent]`, `[tumbling]` and `[attachment]`.
#[derive(Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ScenarioFile {
    /// Seed of everything random, 0 to 2⁶³-1 (default 1).
    #[serde(default = "first_seed")]
    seed: u64,
    /// The only camera of each spacecraft.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<ImagerConfig>")]
    camera: Option<CameraTable>,
    /// Several cameras of each spacecraft, instead of `[camera]`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(with = "Vec<ImagerConfig>")]
    cameras: Vec<CameraTable>,
    /// The detector of every camera that has none of its own.
    #[serde(skip_serializing_if = "Option::is_none")]
    sensor: Option<SensorConfig>,
    /// The truth to write beside the images.
    #[serde(default)]
    truth: TruthConfig,
    /// How finely the images are drawn.
    #[serde(default)]
    render: RenderConfig,
    /// The squares of a map of the landing area (default: see its table).
    #[serde(skip_serializing_if = "Option::is_none")]
    survey: Option<SurveyConfig>,
    /// A powered descent to a landing site.
    #[serde(skip_serializing_if = "Option::is_none")]
    descent: Option<DescentConfig>,
    /// A body that tumbles in front of a camera.
    #[serde(skip_serializing_if = "Option::is_none")]
    tumbling: Option<TumblingConfig>,
    /// Linked spacecraft that descend together to a site on a small body.
    #[serde(skip_serializing_if = "Option::is_none")]
    attachment: Option<AttachmentConfig>,
}

/// A camera as it stands in a file: the default field of view depends on the mission, and none may stand beside focal
/// lengths; an entry of `[[cameras]]` may have a detector of its own.
#[derive(Debug, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct CameraTable {
    width_px: u32,
    height_px: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    fov_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    focal_px: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    center_px: Option<[f64; 2]>,
    turn_deg: [f64; 3],
    offset_m: [f64; 3],
    distortion: DistortionConfig,
    #[serde(skip_serializing_if = "Option::is_none")]
    sensor: Option<SensorConfig>,
}

impl Default for CameraTable {
    fn default() -> Self {
        let mut table = CameraTable::from(CameraConfig::default());
        table.fov_deg = None;
        table
    }
}

impl From<CameraConfig> for CameraTable {
    fn from(config: CameraConfig) -> Self {
        let CameraConfig { width_px, height_px, fov_deg, focal_px, center_px, distortion, turn_deg, offset_m } = config;
        let fov_deg = focal_px.is_none().then_some(fov_deg);
        let sensor = None;
        CameraTable { width_px, height_px, fov_deg, focal_px, center_px, turn_deg, offset_m, distortion, sensor }
    }
}

impl CameraTable {
    /// The camera, with the mission's field of view unless the file has one, and `sensor` unless it has its own.
    fn resolve(self, mission_fov_deg: f64, sensor: &SensorConfig) -> Result<ImagerConfig, &'static str> {
        if self.fov_deg.is_some() && self.focal_px.is_some() {
            return Err("a camera has both fov_deg and focal_px: drop one");
        }
        let camera = CameraConfig {
            width_px: self.width_px,
            height_px: self.height_px,
            fov_deg: self.fov_deg.unwrap_or(mission_fov_deg),
            focal_px: self.focal_px,
            center_px: self.center_px,
            distortion: self.distortion,
            turn_deg: self.turn_deg,
            offset_m: self.offset_m,
        };
        Ok(ImagerConfig { camera, sensor: self.sensor.unwrap_or(*sensor) })
    }
}

fn first_seed() -> u64 {
    1
}

impl ScenarioFile {
    /// Reads the text alone first, so that its own faults are told with their line, then lays the layers over it.
    pub fn parse(text: &str, path: &Path, layers: &Layers) -> Result<Self, SceneError> {
        let file = SettingsFile::parse(text, path)?;
        file.check_keys(&ScenarioFile::schema())?;
        let alone = file.deserialized()?;
        if *layers == Layers::default() {
            return Ok(alone);
        }
        let unusable = |error: SettingsError| SceneError::Unusable { path: path.into(), problem: error.to_string() };
        layers.over(file.table).map_err(unusable)
    }

    /// Fills in what depends on the mission.
    pub fn resolve(self, path: &Path) -> Result<Scenario, SceneError> {
        let unusable = |problem: &str| SceneError::Unusable { path: path.into(), problem: problem.into() };
        let missions: Vec<(Mission, f64)> = [
            self.descent.map(|descent| (Mission::Descent(descent), DESCENT_FOV_DEG)),
            self.tumbling.map(|tumbling| (Mission::Tumbling(tumbling), BODY_FOV_DEG)),
            self.attachment.map(|attachment| (Mission::Attachment(attachment), BODY_FOV_DEG)),
        ]
        .into_iter()
        .flatten()
        .collect();
        let [(mission, fov_deg)] = <[_; 1]>::try_from(missions).map_err(|found| {
            unusable(match found.len() {
                0 => "it has neither a table [descent], [tumbling] nor [attachment]: add one",
                _ => "it has more than one of the tables [descent], [tumbling] and [attachment]: keep one",
            })
        })?;
        if self.camera.is_some() && !self.cameras.is_empty() {
            return Err(unusable("it has both a table [camera] and tables [[cameras]]: drop one"));
        }
        let sensor = self.sensor.unwrap_or_default();
        let tables = if self.cameras.is_empty() { vec![self.camera.unwrap_or_default()] } else { self.cameras };
        let imagers = tables.into_iter().map(|table| table.resolve(fov_deg, &sensor)).collect::<Result<_, _>>();
        Ok(Scenario {
            seed: self.seed,
            imagers: imagers.map_err(unusable)?,
            truth: self.truth,
            render: self.render,
            survey: self.survey,
            mission,
        })
    }

    /// The JSON schema of the file.
    pub fn schema() -> serde_json::Value {
        schemars::schema_for!(ScenarioFile).to_value()
    }

    /// The text of the file.
    pub fn to_toml(&self) -> String {
        toml::to_string(self).expect("a scenario is plain data")
    }
}

impl From<&Scenario> for ScenarioFile {
    fn from(scenario: &Scenario) -> Self {
        let (mut descent, mut tumbling, mut attachment) = (None, None, None);
        match &scenario.mission {
            Mission::Descent(config) => descent = Some(config.clone()),
            Mission::Tumbling(config) => tumbling = Some(config.clone()),
            Mission::Attachment(config) => attachment = Some(config.clone()),
        }
        let table = |imager: &ImagerConfig| CameraTable::from(imager.camera);
        let entry = |imager: &ImagerConfig| CameraTable { sensor: Some(imager.sensor), ..table(imager) };
        let (camera, sensor, cameras) = match scenario.imagers.as_slice() {
            [only] => (Some(table(only)), Some(only.sensor), Vec::new()),
            several => (None, None, several.iter().map(entry).collect()),
        };
        ScenarioFile {
            seed: scenario.seed,
            camera,
            sensor,
            cameras,
            truth: scenario.truth,
            render: scenario.render,
            survey: scenario.survey.clone(),
            descent,
            tumbling,
            attachment,
        }
    }
}
