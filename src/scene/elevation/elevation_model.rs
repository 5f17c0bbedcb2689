//! An elevation model in the site frame.

use super::block_bounds::{BlockBounds, Blocks};
use super::fill::fill_unknown;
use super::grid::Grid;
use super::map_site::MapPlace;
use super::raster::Raster;
use super::site_map::{Located, SiteMap};
use crate::scene::error::SceneError;
use nalgebra::{Vector2, Vector3};
use serde::Serialize;

/// Heights between the posts of a raster, as heights above the plane of the site.
#[derive(Debug, Clone, PartialEq)]
pub struct ElevationModel {
    map: SiteMap,
    heights: Grid,
    blocks: Blocks,
    wraps: bool,
    summary: ElevationSummary,
}

/// What an elevation model is, in numbers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ElevationSummary {
    /// Posts in a row, and rows.
    pub posts: [usize; 2],
    /// Posts without data that were filled from their surroundings.
    pub filled_posts: usize,
    /// Distance between posts eastward and northward at the site, m.
    pub post_m: [f64; 2],
    /// Where the site's origin lies on the map.
    pub site: MapPlace,
    /// Height of the site's origin above the model's datum, m.
    pub site_height_m: f64,
    /// Lowest and highest post above the model's datum, m.
    pub height_range_m: [f64; 2],
}

/// No derivative between posts exceeds this times the largest step between neighbours: a one-dimensional cubic reaches
/// 1.5 + 2 · 0.25 of its steps, and the weights across add up to 1 + 2 · 0.125 in magnitude.
const CUBIC_SLOPE: f64 = 2.0 * 1.25;
/// Values between posts go beyond those of the posts by at most this share of their range on either side.
const CUBIC_OVERSHOOT: f64 = 0.29;
/// Up to this distance in m a curved map is nearly straight.
const LOCAL_M: f64 = 20_000.0;
/// Steps of Newton's method: the first leaves millimetres, the fourth nothing.
const MOST_STEPS: usize = 12;

impl ElevationModel {
    /// Model of a raster of heights in m with the site's origin at a place; in the middle without one.
    ///
    /// # Errors
    /// Names `descent.elevation.site` if the place does not lie on the raster, or where no post around it is known.
    pub fn new(mut raster: Raster, site: Option<&MapPlace>) -> Result<Self, SceneError> {
        let site_column_row = raster.site_column_row(site, "descent.elevation.site")?;
        if raster.is_unknown_around(site_column_row) {
            let place = raster.georeference.place(site_column_row);
            let cure = "no post around it holds data: choose another place or another file";
            return Err(SceneError::out_of_range("descent.elevation.site", place, cure));
        }
        let filled_posts = fill_unknown(raster.columns, &mut raster.values);
        let wraps = raster.georeference.wraps(raster.columns);
        let blocks = Blocks::new(raster.columns, &raster.values, wraps);
        let heights = Grid::new(raster.columns, raster.values, wraps);
        let [column, row] = site_column_row;
        let site_height_m = heights.sample(column, row).value;
        let map = SiteMap::new(&raster.georeference, raster.columns, site_column_row, site_height_m);
        let summary = ElevationSummary {
            posts: heights.size(),
            filled_posts,
            post_m: map.post_m(),
            site: raster.georeference.place(site_column_row),
            site_height_m,
            height_range_m: [blocks.all().low, blocks.all().high].map(f64::from),
        };
        Ok(ElevationModel { map, wraps, blocks, heights, summary })
    }

    /// Height above the plane of the site in m, and its gradient by x and y, at a place in m. The gradient is that of
    /// waves of `finest_m` and more; 0 takes all.
    ///
    /// On a curved map the height z solves F = |P| - R - h(P) = 0 at P = (x, y, z + R + h₀), by Newton's method; the
    /// gradient is -∂F/∂(x, y) / ∂F/∂z.
    pub fn sample(&self, x_m: f64, y_m: f64, finest_m: f64) -> (f64, Vector2<f64>) {
        let mut place_m = Vector3::new(x_m, y_m, self.map.curvature_m(x_m, y_m));
        let mut located = self.map.locate(&place_m);
        for _ in 0..MOST_STEPS {
            let found = self.heights.sample(located.column, located.row);
            let misfit_m = located.height_m - found.value;
            let by_place = slopes(&located, found.by_column, found.by_row);
            place_m.z -= misfit_m / by_place.z;
            if self.map.is_plane() {
                break;
            }
            located = self.map.locate(&place_m);
            if misfit_m.abs() < 1e-6 {
                break;
            }
        }
        let post_m = self.summary.post_m[0].min(self.summary.post_m[1]);
        let seen = self.heights.sample_coarse(located.column, located.row, 0.5 * finest_m / post_m);
        let by_place = slopes(&located, seen.by_column, seen.by_row);
        (place_m.z, -by_place.xy() / by_place.z)
    }

    /// Whether a place in the site frame (m) lies within the outermost posts.
    pub fn covers(&self, place_m: &Vector3<f64>) -> bool {
        let at = self.map.locate(place_m);
        let last = self.heights.size().map(|n| n as f64 - 1.0);
        (self.wraps || (0.0..=last[0]).contains(&at.column)) && (0.0..=last[1]).contains(&at.row)
    }

    /// Distance between posts in m, the larger of both directions: detail finer than that is not in the model.
    pub fn post_m(&self) -> f64 {
        self.summary.post_m[0].max(self.summary.post_m[1])
    }

    /// No ground within `distance_m` of the site, 530 km at most, is steeper than this, rise over run.
    pub fn steepest(&self, distance_m: f64) -> f64 {
        let steps = self.blocks.all().steps.map(f64::from);
        let [east_m, north_m] = self.summary.post_m;
        let (east, north) = (steps[0] * self.map.narrowing() / east_m, steps[1] / north_m);
        CUBIC_SLOPE * east.hypot(north) + self.map.curvature_slope(distance_m)
    }

    /// No ground is higher above the plane of the site than this, in m.
    pub fn highest_m(&self) -> f64 {
        let [low, high] = self.summary.height_range_m;
        high + CUBIC_OVERSHOOT * (high - low) - self.summary.site_height_m
    }

    /// No ground within `reach_m` of a place (m) departs more than this from the height there, in m.
    pub fn relief_bound_m(&self, middle_m: &Vector2<f64>, reach_m: f64) -> f64 {
        let away_m = middle_m.norm();
        let fall_m = |distance_m: f64| self.map.curvature_m(distance_m, 0.0);
        let curvature_m = fall_m((away_m - reach_m).max(0.0)) - fall_m(away_m + reach_m);
        let span_m = |b: &BlockBounds| (1.0 + 2.0 * CUBIC_OVERSHOOT) * f64::from(b.high - b.low);
        if reach_m > LOCAL_M {
            return span_m(&self.blocks.all()).min(self.steepest(0.0) * reach_m) + curvature_m;
        }
        let (height_m, _) = self.sample(middle_m.x, middle_m.y, 0.0);
        let at = self.map.locate(&middle_m.push(height_m));
        let by_place = [at.by_place.row(0).norm(), at.by_place.row(1).norm()];
        // A tenth more, for the map is curved.
        let bounds = self.blocks.around([at.column, at.row], by_place.map(|b| 1.1 * b * reach_m));
        let slope = CUBIC_SLOPE * 1.1 * (0..2).map(|k| f64::from(bounds.steps[k]) * by_place[k]).sum::<f64>();
        span_m(&bounds).min(slope * reach_m) + curvature_m
    }

    /// The model in numbers.
    pub fn summary(&self) -> &ElevationSummary {
        &self.summary
    }
}

/// Derivatives of (height above the datum - model's height) by the place.
fn slopes(located: &Located, by_column: f64, by_row: f64) -> Vector3<f64> {
    let row = |k: usize| located.by_place.row(k).transpose();
    row(2) - row(0) * by_column - row(1) * by_row
}
