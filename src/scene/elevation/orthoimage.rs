//! An orthoimage in the site frame.

use super::config::AlbedoValues;
use super::fill::fill_unknown;
use super::grid::Grid;
use super::map_site::MapPlace;
use super::raster::Raster;
use super::site_map::SiteMap;
use crate::scene::error::SceneError;
use nalgebra::Vector3;

/// Pixels beyond the border within which the image fades to the terrain's mean albedo.
const FADE_PX: f64 = 16.0;

/// Albedo between the pixels of an image of the ground from above.
#[derive(Debug, Clone, PartialEq)]
pub struct Orthoimage {
    map: SiteMap,
    /// Albedo over the terrain's mean albedo, minus 1.
    change: Grid,
    wraps: bool,
    post_m: [f64; 2],
}

impl Orthoimage {
    /// Orthoimage of a raster with the site's origin at a place, `site_height_m` above the datum; in the middle without
    /// one. `mean_albedo` is the terrain's.
    ///
    /// # Errors
    /// Names `descent.orthoimage.site` if the place does not lie on the raster, and the values if they have no mean.
    pub fn new(
        mut raster: Raster,
        site: (Option<&MapPlace>, f64),
        (values, mean_albedo): (AlbedoValues, f64),
    ) -> Result<Self, SceneError> {
        let site_column_row = raster.site_column_row(site.0, "descent.orthoimage.site")?;
        let mean = match values {
            AlbedoValues::Absolute => mean_albedo,
            AlbedoValues::Relative => mean_of_known(&raster.values),
        };
        if mean <= 0.0 {
            let cure = "it must be positive to compare values with: correct scale, offset or no_data";
            return Err(SceneError::out_of_range("descent.orthoimage: the mean albedo", mean, cure));
        }
        fill_unknown(raster.columns, &mut raster.values);
        raster.values.iter_mut().for_each(|v| *v = (f64::from(*v) / mean - 1.0) as f32);
        let map = SiteMap::new(&raster.georeference, raster.columns, site_column_row, site.1);
        let wraps = raster.georeference.wraps(raster.columns);
        let change = Grid::new(raster.columns, raster.values, wraps);
        Ok(Orthoimage { post_m: map.post_m(), change, wraps, map })
    }

    /// Relative change of the albedo at a place in the site frame, m, of waves of `finest_m` and more; 0 takes all. It
    /// fades to 0 within 16 pixels beyond the border.
    pub fn change(&self, place_m: &Vector3<f64>, finest_m: f64) -> f64 {
        let at = self.map.locate(place_m);
        let [columns, rows] = self.change.size().map(|n| n as f64 - 1.0);
        let beyond = |at: f64, last: f64| (-at).max(at - last).max(0.0);
        let beyond_px = if self.wraps { 0.0 } else { beyond(at.column, columns) }.max(beyond(at.row, rows));
        if beyond_px >= FADE_PX {
            return 0.0;
        }
        let post_m = self.post_m[0].min(self.post_m[1]);
        let change = self.change.sample_coarse(at.column, at.row, 0.5 * finest_m / post_m).value;
        change * (1.0 - beyond_px / FADE_PX)
    }

    /// Distance between pixels in m, the larger of both directions.
    pub fn post_m(&self) -> f64 {
        self.post_m[0].max(self.post_m[1])
    }
}

fn mean_of_known(values: &[f32]) -> f64 {
    let known = values.iter().filter(|v| !v.is_nan()).map(|v| f64::from(*v));
    let (sum, count) = known.fold((0.0, 0.0), |(sum, count), v| (sum + v, count + 1.0));
    sum / count
}
