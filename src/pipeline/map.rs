//! A scenario to a map of its landing area.

use super::error::PipelineError;
use super::progress::Progress;
use crate::dataset::{GroundMap, write_ground_map, write_text};
use crate::render::{Gpu, map_level};
use crate::scene::{Scenario, Scene, SurveyLevel};
use std::path::{Path, PathBuf};

/// What to map, and where to.
#[derive(Debug, Clone)]
pub struct MapRequest {
    /// The scenario file, of a descent.
    pub scenario: PathBuf,
    /// The map's folder.
    pub out: PathBuf,
    /// `key=value` changes to the scenario, dotted keys, such as those of another Sun.
    pub overrides: Vec<String>,
    /// The squares to map, from fine to coarse.
    pub levels: Vec<SurveyLevel>,
    /// Part of the name of the graphics adapter to use.
    pub adapter: Option<String>,
}

impl MapRequest {
    /// 0.5 m a pixel in the inner kilometre, 2 m over 4 km, 8 m over 20 km.
    pub const LEVELS: [SurveyLevel; 3] = [
        SurveyLevel { metres_per_px: 0.5, side_m: 1000.0 },
        SurveyLevel { metres_per_px: 2.0, side_m: 4000.0 },
        SurveyLevel { metres_per_px: 8.0, side_m: 20_000.0 },
    ];
}

/// Draws the map and writes it; the resolved scenario goes beside it.
///
/// # Errors
/// A scenario that is no descent, levels out of range or not from fine to coarse, no adapter, or a file that cannot be
/// written.
pub fn make_map(request: &MapRequest, progress: &dyn Progress) -> Result<GroundMap, PipelineError> {
    let scenario = Scenario::read(&request.scenario, &request.overrides)?;
    let Scene::Descent(scene) = scenario.build(request.scenario.parent().unwrap_or(Path::new(".")))? else {
        return Err(PipelineError::NoDescent { path: request.scenario.clone() });
    };
    request.levels.iter().try_for_each(SurveyLevel::validate)?;
    if !request.levels.is_sorted_by(|a, b| a.metres_per_px < b.metres_per_px) || request.levels.is_empty() {
        return Err(PipelineError::LevelOrder);
    }
    let gpu = Gpu::new(request.adapter.as_deref())?;
    let sun = (scene.sun_in_site, scene.sun_angular_radius_rad);
    let mut map = GroundMap { levels: Vec::new() };
    progress.begin("mapping", request.levels.len());
    for (index, level) in request.levels.iter().enumerate() {
        map.levels.push(map_level(&gpu, &scene.terrain, sun, (level, &scenario.render))?);
        progress.advance_to(index + 1);
    }
    progress.end();
    write_ground_map(&request.out, &map)?;
    write_text(&request.out.join("scenario.toml"), &scenario.to_toml())?;
    Ok(map)
}
