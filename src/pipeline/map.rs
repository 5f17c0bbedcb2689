//! A scenario to a map of its landing area.

use super::error::PipelineError;
use super::progress::Progress;
use crate::dataset::{GroundMap, write_ground_map, write_text};
use crate::render::{Gpu, map_level};
use crate::scene::{Scenario, Scene, SurveyLevel};
use crate::settings::Layers;
use std::path::{Path, PathBuf};

/// What to map, and where to.
#[derive(Debug, Clone)]
pub struct MapRequest {
    /// The scenario file, of a descent.
    pub scenario: PathBuf,
    /// The map's folder.
    pub out: PathBuf,
    /// What is laid over the scenario.
    pub layers: Layers,
    /// The squares to map, from fine to coarse; those of the scenario if there are none.
    pub levels: Vec<SurveyLevel>,
    /// Part of the name of the graphics adapter to use.
    pub adapter: Option<String>,
}

/// Draws the map and writes it; the scenario and all settings, its squares included, go beside it.
///
/// # Errors
/// A scenario that is no descent, levels out of range or not from fine to coarse, no adapter, or a file that cannot be
/// written.
pub fn make_map(request: &MapRequest, progress: &dyn Progress) -> Result<GroundMap, PipelineError> {
    let scenario = Scenario::read_under(&request.scenario, &request.layers)?;
    let Scene::Descent(scene) = scenario.build(request.scenario.parent().unwrap_or(Path::new(".")))? else {
        return Err(PipelineError::NoDescent { path: request.scenario.clone() });
    };
    let mut survey = scenario.survey.clone().unwrap_or_default();
    if !request.levels.is_empty() {
        survey.levels.clone_from(&request.levels);
    }
    survey.validate().map_err(|e| e.under("survey"))?;
    let gpu = Gpu::new(request.adapter.as_deref())?;
    let sun = (scene.sun_in_site, scene.sun_angular_radius_rad);
    let mut map = GroundMap { levels: Vec::new() };
    progress.begin("mapping", survey.levels.len());
    for (index, level) in survey.levels.iter().enumerate() {
        map.levels.push(map_level(&gpu, &scene.terrain, sun, (level, &scenario.render))?);
        progress.advance_to(index + 1);
    }
    progress.end();
    write_ground_map(&request.out, &map)?;
    let drawn = Scenario { survey: None, ..scenario };
    write_text(&request.out.join("scenario.toml"), &drawn.to_toml())?;
    let resolved = Scenario { survey: Some(survey), ..drawn };
    write_text(&request.out.join("settings.toml"), &resolved.to_toml())?;
    Ok(map)
}
