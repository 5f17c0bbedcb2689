//! An elevation model in the site frame.

use super::fill::fill_unknown;
use super::grid::Grid;
use super::site_map::{Located, SiteMap};
use super::{MapPlace, Raster};
use crate::scene::SceneError;
use nalgebra::{Vector2, Vector3};
use serde::Serialize;

/// Heights between the posts of a raster, as heights above the plane of the site.
#[derive(Debug, Clone, PartialEq)]
pub struct ElevationModel {
    map: SiteMap,
    heights: Grid,
    wraps: bool,
    /// Bounds of the slope by east and north, rise over run.
    steepest: Vector2<f64>,
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
/// Steps of Newton's method: the first leaves millimetres, the fourth nothing.
const MOST_STEPS: usize = 12;

impl ElevationModel {
    /// Model of a raster of heights in m with the site's origin at a place; in the middle without one.
    ///
    /// # Errors
    /// Names `descent.elevation.site` if the place does not lie on the raster.
    pub fn new(mut raster: Raster, site: Option<&MapPlace>) -> Result<Self, SceneError> {
        let site_column_row = raster.site_column_row(site, "descent.elevation.site")?;
        let filled_posts = fill_unknown(raster.columns, &mut raster.values);
        let wraps = raster.georeference.wraps(raster.columns);
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
            height_range_m: heights.range(),
        };
        let steps_m = heights.largest_steps();
        let slope = |axis: usize| CUBIC_SLOPE * steps_m[axis] / map.post_m()[axis];
        Ok(ElevationModel { map, wraps, steepest: Vector2::new(slope(0), slope(1)), heights, summary })
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

    /// No ground within `distance_m` of the site is steeper than this, rise over run.
    pub fn steepest(&self, distance_m: f64) -> f64 {
        self.steepest.norm() + self.map.curvature_slope(distance_m)
    }

    /// No ground is higher above the plane of the site than this, in m.
    pub fn highest_m(&self) -> f64 {
        let [low, high] = self.summary.height_range_m;
        high + CUBIC_OVERSHOOT * (high - low) - self.summary.site_height_m
    }

    /// No two places of the ground differ by more than this in m, but for the planet's curvature.
    pub fn relief_m(&self) -> f64 {
        let [low, high] = self.summary.height_range_m;
        (1.0 + 2.0 * CUBIC_OVERSHOOT) * (high - low)
    }

    /// How far the sphere through the site falls from the place nearest to the site to the farthest, m.
    pub fn curvature_drop_m(&self, nearest_m: f64, farthest_m: f64) -> f64 {
        self.map.curvature_m(nearest_m, 0.0) - self.map.curvature_m(farthest_m, 0.0)
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
