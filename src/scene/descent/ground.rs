//! The ground under a descent.

use super::config::DescentConfig;
use crate::scene::error::SceneError;
use crate::scene::terrain::{GroundBase, Terrain};
use crate::scene::view::View;
use crate::settings::OutOfRange;
use std::path::Path;

/// The ground, on what the scenario names of measured files; relative paths start at `base_folder`.
pub(super) fn ground(config: &DescentConfig, seed: u64, base_folder: &Path) -> Result<Terrain, SceneError> {
    let orthoimage = config.orthoimage.as_deref().map(|o| (o, config.terrain.albedo));
    let base = GroundBase::read(config.elevation.as_deref(), orthoimage, base_folder)?;
    Ok(match base {
        Some(base) => Terrain::on_base(&config.terrain, base, seed),
        None => Terrain::new(&config.terrain, seed),
    })
}

/// Beyond the border of an elevation model the ground is only its continuation: no image is taken above that.
pub(super) fn check_above_model(views: &[View], terrain: &Terrain) -> Result<(), OutOfRange> {
    let Some(elevation) = terrain.base().and_then(|base| base.elevation.as_ref()) else { return Ok(()) };
    let place_m = |view: &View| view.reference_from_camera.translation.vector;
    match views.iter().find(|view| !elevation.covers(&place_m(view))) {
        None => Ok(()),
        Some(view) => {
            let [x_m, y_m]: [f64; 2] = place_m(view).xy().into();
            let cure = format!(
                "the camera flies beyond the elevation model, {x_m:.0} m east and {y_m:.0} m north of the site at t = \
                 {:.2} s: move the site inward or use a larger file",
                view.t_ns as f64 * 1e-9
            );
            Err(OutOfRange::new("descent.elevation.site", elevation.summary().site, cure))
        }
    }
}
