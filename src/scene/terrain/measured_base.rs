//! What is measured of the ground: its heights, its albedo, or both.

use super::relief::{GroundDetail, GroundSample};
use crate::scene::elevation::{ElevationConfig, ElevationModel, MapSite, Orthoimage, OrthoimageConfig, Raster};
use crate::scene::error::SceneError;
use nalgebra::{Vector2, Vector3};
use std::path::Path;

/// The measured base of a terrain, in the site frame.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct GroundBase {
    /// Heights; a plane without.
    pub elevation: Option<ElevationModel>,
    /// Albedo; the terrain's mean without.
    pub orthoimage: Option<Orthoimage>,
    /// Whether procedural relief, craters and rocks are added below the heights' resolution.
    pub relief_detail: bool,
    /// Whether procedural albedo is added below the orthoimage's resolution.
    pub albedo_detail: bool,
}

impl GroundBase {
    /// Reads what a scenario names; relative paths start at `base_folder`. `None` if it names nothing.
    ///
    /// # Errors
    /// Names the file or the key at fault.
    pub fn read(
        elevation: Option<&ElevationConfig>,
        orthoimage: Option<(&OrthoimageConfig, f64)>,
        base_folder: &Path,
    ) -> Result<Option<GroundBase>, SceneError> {
        if elevation.is_none() && orthoimage.is_none() {
            return Ok(None);
        }
        let mut base = GroundBase {
            relief_detail: elevation.is_none_or(|e| e.detail),
            albedo_detail: orthoimage.is_none_or(|(o, _)| o.detail),
            ..GroundBase::default()
        };
        if let Some(config) = elevation {
            let path = base_folder.join(&config.file.path);
            let raster = Raster::read(&config.file, base_folder)?;
            let site = config.site.stated();
            base.elevation = Some(ElevationModel::new(raster, site.as_ref()).map_err(|e| e.in_file(&path))?);
        }
        if let Some((config, mean_albedo)) = orthoimage {
            base.orthoimage = Some(base.read_orthoimage(config, mean_albedo, base_folder)?);
        }
        Ok(Some(base))
    }

    fn read_orthoimage(
        &self,
        config: &OrthoimageConfig,
        mean_albedo: f64,
        base_folder: &Path,
    ) -> Result<Orthoimage, SceneError> {
        let raster = Raster::read(&config.file, base_folder)?;
        let summary = self.elevation.as_ref().map(|e| *e.summary());
        let site = match config.site {
            None => summary.map(|s| s.site),
            Some(site) => MapSite::stated(&site),
        };
        let site = (site.as_ref(), summary.map_or(0.0, |s| s.site_height_m));
        let path = base_folder.join(&config.file.path);
        Orthoimage::new(raster, site, (config.values, mean_albedo)).map_err(|e| e.in_file(&path))
    }

    /// Ground without procedural detail at a place in m. Heights count whole; gradient and albedo are those of the waves
    /// that `detail.height_m` lets through.
    pub fn sample(&self, x_m: f64, y_m: f64, detail: &GroundDetail) -> GroundSample {
        let (height_m, gradient) = match &self.elevation {
            Some(elevation) => elevation.sample(x_m, y_m, detail.height_m),
            None => (0.0, Vector2::zeros()),
        };
        let place_m = Vector3::new(x_m, y_m, height_m);
        let albedo_change = self.orthoimage.as_ref().map_or(0.0, |o| o.change(&place_m, detail.height_m));
        GroundSample { height_m, gradient, albedo_change }
    }
}
