//! A scenario: everything that makes a scene, with every default filled in.

use super::file::ScenarioFile;
use super::mission::{Mission, Scene};
use super::render_config::RenderConfig;
use super::truth_config::TruthConfig;
use crate::scene::attachment::AttachmentScene;
use crate::scene::camera::{Imager, ImagerConfig};
use crate::scene::descent::DescentScene;
use crate::scene::error::SceneError;
use crate::scene::survey::SurveyConfig;
use crate::scene::tumbling::TumblingScene;
use crate::settings::{Layers, OutOfRange, limits};
use std::path::Path;

/// A scenario.
#[derive(Debug, Clone, PartialEq)]
pub struct Scenario {
    /// Seed of everything random, 0 to 2⁶³-1 (default 1).
    pub seed: u64,
    /// The cameras of each spacecraft, at least one: the tables `[camera]` and `[sensor]`, or `[[cameras]]`.
    pub imagers: Vec<ImagerConfig>,
    /// The truth to write beside the images: the table `[truth]`.
    pub truth: TruthConfig,
    /// How finely the images are drawn: the table `[render]`.
    pub render: RenderConfig,
    /// The squares that a map of the landing area shows: the table `[survey]`; `None` for the default ones.
    pub survey: Option<SurveyConfig>,
    /// What happens.
    pub mission: Mission,
}

impl Scenario {
    /// Reads a scenario file and applies overrides of the form `table.key=value`, each value in TOML's notation (quotes
    /// may be left out around text).
    ///
    /// # Errors
    /// Names the file and the key of what is missing, unknown, of the wrong type or out of range.
    pub fn read(path: &Path, overrides: &[String]) -> Result<Scenario, SceneError> {
        Scenario::read_under(path, &Layers::from(overrides))
    }

    /// Reads a scenario file and lays a file of settings and overrides over it.
    ///
    /// # Errors
    /// As [`Scenario::read`].
    pub fn read_under(path: &Path, layers: &Layers) -> Result<Scenario, SceneError> {
        let text = std::fs::read_to_string(path).map_err(|source| SceneError::Io {
            action: "read the scenario",
            path: path.into(),
            source,
        })?;
        Scenario::parse_under(&text, path, layers)
    }

    /// Reads a scenario from text; `path` is what errors name.
    ///
    /// # Errors
    /// As [`Scenario::read`].
    pub fn parse(text: &str, path: &Path, overrides: &[String]) -> Result<Scenario, SceneError> {
        Scenario::parse_under(text, path, &Layers::from(overrides))
    }

    fn parse_under(text: &str, path: &Path, layers: &Layers) -> Result<Scenario, SceneError> {
        let scenario = ScenarioFile::parse(text, path, layers)?.resolve(path)?;
        scenario.validate().map_err(|e| SceneError::from(e).in_file(path))?;
        Ok(scenario)
    }

    /// The scenario as a file with every key; it reads back equal.
    pub fn to_toml(&self) -> String {
        ScenarioFile::from(self).to_toml()
    }

    /// The JSON schema of a scenario file; descriptions come from the documentation of the types.
    pub fn schema() -> serde_json::Value {
        ScenarioFile::schema()
    }

    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::seed("seed", self.seed)?;
        self.render.validate().map_err(|e| e.under("render"))?;
        for (index, imager) in self.imagers.iter().enumerate() {
            imager.validate((self.imagers.len() > 1).then_some(index))?;
        }
        self.survey.as_ref().map_or(Ok(()), SurveyConfig::validate).map_err(|e| e.under("survey"))?;
        match &self.mission {
            Mission::Descent(descent) => descent.validate().map_err(|e| e.under("descent")),
            Mission::Attachment(attachment) => attachment.validate().map_err(|e| e.under("attachment")),
            Mission::Tumbling(tumbling) => {
                let first = &self.imagers[0].camera;
                let half_side_px = 0.5 * f64::from(first.width_px.min(first.height_px));
                for offset_px in tumbling.center_offset_px {
                    limits::within("tumbling.center_offset_px", offset_px, -half_side_px, half_side_px)?;
                }
                tumbling.validate().map_err(|e| e.under("tumbling"))
            }
        }
    }

    /// Builds the scene; relative paths of shapes and rasters start at `base_folder`, the folder of the scenario file.
    ///
    /// # Errors
    /// Names the key or the shape file at fault.
    pub fn build(&self, base_folder: &Path) -> Result<Scene, SceneError> {
        self.validate()?;
        let imagers: Vec<Imager> = self.imagers.iter().map(ImagerConfig::imager).collect();
        match &self.mission {
            Mission::Descent(descent) => {
                DescentScene::new(descent, &imagers, self.seed, base_folder).map(|s| Scene::Descent(Box::new(s)))
            }
            Mission::Attachment(attachment) => AttachmentScene::new(attachment, &imagers, self.seed, base_folder)
                .map(|s| Scene::Attachment(Box::new(s))),
            Mission::Tumbling(tumbling) => {
                TumblingScene::new(tumbling, &imagers, self.seed, base_folder).map(|s| Scene::Tumbling(Box::new(s)))
            }
        }
    }
}
