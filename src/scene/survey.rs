//! A survey of the ground about a site from high above: what a map of it is made from.

use super::terrain::{GroundDetail, Terrain};
use crate::geometry::{Camera, Distortion};
use crate::settings::{OutOfRange, limits};
use crate::stats::random_stream;
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector2, Vector3};
use rand::RngExt;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Height of the camera over the edge of the square that it surveys: it looks down at no more than 14° off its axis along
/// either side, and shadows are as sharp as in any other image.
const HEIGHT_OVER_SIDE: f64 = 2.0;
/// Posts along the edge of a block whose heights are evaluated together.
const BLOCK: usize = 64;
/// Most pixels along an edge.
const MOST_POSTS: f64 = 8192.0;

/// The squares of a map of the landing area, which `opnav map` draws.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SurveyConfig {
    /// Squares about the site, from fine to coarse (default 0.5 m a pixel over 1000 m, 2 m over 4000 m, 8 m over 20000 m).
    pub levels: Vec<SurveyLevel>,
}

impl Default for SurveyConfig {
    fn default() -> Self {
        let squares = [(0.5, 1000.0), (2.0, 4000.0), (8.0, 20_000.0)];
        SurveyConfig { levels: squares.map(|(metres_per_px, side_m)| SurveyLevel { metres_per_px, side_m }).to_vec() }
    }
}

impl SurveyConfig {
    /// Checks every square, and that they go from fine to coarse.
    ///
    /// # Errors
    /// Names the key at fault.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        for (index, level) in self.levels.iter().enumerate() {
            level.validate().map_err(|e| e.under(&index.to_string()).under("levels"))?;
        }
        if !self.levels.is_sorted_by(|a, b| a.metres_per_px < b.metres_per_px) || self.levels.is_empty() {
            let found: Vec<String> = self.levels.iter().map(|level| level.metres_per_px.to_string()).collect();
            let cure = "it goes from fine to coarse, and there is at least one: order the squares by metres a pixel";
            return Err(OutOfRange::new("levels", format!("[{}] m a pixel", found.join(", ")), cure));
        }
        Ok(())
    }
}

/// One square of a survey, centred on the site's origin.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SurveyLevel {
    /// Distance between posts, m, 0.001 to 10000.
    pub metres_per_px: f64,
    /// Distance from the first post of a row to its last, m, 16 to 8190 posts' distances; rounded to a whole, even number
    /// of them.
    pub side_m: f64,
}

impl SurveyLevel {
    /// Checks the level.
    ///
    /// # Errors
    /// Names the value outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::within("metres_per_px", self.metres_per_px, 1e-3, 1e4)?;
        limits::within("side_m", self.side_m, 16.0 * self.metres_per_px, (MOST_POSTS - 2.0) * self.metres_per_px)
    }

    /// Posts along a side: an odd number, so that one stands on the origin.
    pub fn posts(&self) -> usize {
        2 * (0.5 * self.side_m / self.metres_per_px).round() as usize + 1
    }

    /// Place (x, y) of the first post, the north-western one, m; columns run along +x, rows along -y.
    pub fn first_in_site_m(&self) -> Vector2<f64> {
        Vector2::new(-1.0, 1.0) * (self.metres_per_px * (self.posts() / 2) as f64)
    }

    /// Height of the ground at each post, m, row by row, with the details that posts this far apart can hold.
    pub fn heights_m(&self, terrain: &Terrain) -> Vec<f32> {
        let posts = self.posts();
        let detail = self.detail();
        let place = |column: usize, row: usize| self.place_m(column as f64, row as f64);
        let rows_of_blocks: Vec<Vec<f32>> = (0..posts.div_ceil(BLOCK))
            .into_par_iter()
            .map(|band| {
                let rows = band * BLOCK..((band + 1) * BLOCK).min(posts);
                let mut heights_m = vec![0.0; rows.len() * posts];
                for first in (0..posts).step_by(BLOCK) {
                    let columns = first..(first + BLOCK).min(posts);
                    let (west_north, east_south) = (place(first, rows.start), place(columns.end - 1, rows.end - 1));
                    let low_m = Vector2::new(west_north.x, east_south.y).add_scalar(-self.metres_per_px);
                    let high_m = Vector2::new(east_south.x, west_north.y).add_scalar(self.metres_per_px);
                    let patch = terrain.patch(&low_m, &high_m, &detail);
                    for row in rows.clone() {
                        for column in columns.clone() {
                            let at = place(column, row);
                            heights_m[(row - rows.start) * posts + column] = patch.sample(at.x, at.y).height_m as f32;
                        }
                    }
                }
                heights_m
            })
            .collect();
        rows_of_blocks.concat()
    }

    /// R.m.s. difference in m between the ground with every detail and the posts' heights, bilinear between them, at
    /// places drawn at random.
    pub fn height_error_m(&self, terrain: &Terrain, heights_m: &[f32]) -> f64 {
        const PLACES: usize = 2000;
        let posts = self.posts();
        let mut random = random_stream(0, "survey places", posts as u64);
        let mut draw = || random.random_range(0.0..(posts - 1) as f64);
        let places: Vec<(f64, f64)> = (0..PLACES).map(|_| (draw(), draw())).collect();
        let squared = |(column, row): &(f64, f64)| {
            let (s, t) = (column.fract(), row.fract());
            let first = *row as usize * posts + *column as usize;
            let [a, b, c, d] = [first, first + 1, first + posts, first + posts + 1].map(|k| f64::from(heights_m[k]));
            let at = self.place_m(*column, *row);
            let between_m = (a * (1.0 - s) + b * s) * (1.0 - t) + (c * (1.0 - s) + d * s) * t;
            (terrain.height_m(at.x, at.y) - between_m).powi(2)
        };
        let all: Vec<f64> = places.par_iter().map(squared).collect();
        (all.iter().sum::<f64>() / PLACES as f64).sqrt()
    }

    /// A camera that sees all posts from [`SurveyLevel::site_from_camera`], `metres_per_px` a pixel at the origin's height,
    /// given the largest height or depth among the posts, m.
    pub fn camera(&self, relief_m: f64) -> Camera {
        let above_m = HEIGHT_OVER_SIDE * self.side_m;
        let leaning_m = 0.5 * self.side_m * relief_m / (above_m - relief_m).max(0.1 * above_m);
        let size_px = self.posts() as u32 + 2 * (leaning_m / self.metres_per_px).ceil() as u32 + 8;
        let middle_px = 0.5 * f64::from(size_px) - 0.5;
        Camera {
            width_px: size_px,
            height_px: size_px,
            focal_px: Vector2::repeat(above_m / self.metres_per_px),
            center_px: Vector2::repeat(middle_px),
            distortion: Distortion::None,
        }
    }

    /// Pose of that camera: straight above the origin, the image's top to the north (+y).
    pub fn site_from_camera(&self) -> Isometry3<f64> {
        let rotation = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
        Isometry3::from_parts(Translation3::new(0.0, 0.0, HEIGHT_OVER_SIDE * self.side_m), rotation)
    }

    /// Place (x, y) of a column and row, m.
    pub fn place_m(&self, column: f64, row: f64) -> Vector2<f64> {
        self.first_in_site_m() + Vector2::new(column, -row) * self.metres_per_px
    }

    fn detail(&self) -> GroundDetail {
        let size_m = self.metres_per_px;
        GroundDetail {
            height_m: size_m,
            shade_m: f64::INFINITY,
            feature_m: size_m,
            rock_m: 0.5 * size_m,
            footprint_m: 0.0,
        }
    }
}
