//! A map as rays and pixels of any size see it.

use crate::dataset::{GroundMap, MapLevel};
use nalgebra::{Vector2, Vector3};

/// Steps of a ray until it stands on the ground, at most.
const MOST_STEPS: usize = 16;
/// A ray stands on the ground when it is this near, in footprints of a pixel…
const SETTLED: f64 = 0.02;
/// …or, after all steps, this near: beside a seam between levels.
const NEAR: f64 = 0.3;

/// A map with smaller copies of its images.
#[derive(Debug, Clone)]
pub(super) struct MapGround {
    map: GroundMap,
    /// Copies of each level, each half as large as the one before.
    copies: Vec<Vec<Copy>>,
    mean_height_m: f64,
}

/// A place on the ground that a ray meets.
#[derive(Debug, Clone, Copy)]
pub(super) struct Meeting {
    pub(super) point_in_site_m: Vector3<f64>,
    /// Index of the level that knows the place.
    pub(super) level: usize,
    /// Edge of a pixel there, seen face on, m.
    pub(super) footprint_m: f64,
}

#[derive(Debug, Clone)]
struct Copy {
    width: usize,
    height: usize,
    /// Brightness, 0 to 1; NaN where nothing is known.
    brightness: Vec<f32>,
}

impl MapGround {
    pub(super) fn new(map: &GroundMap) -> Self {
        let (mut sum_m, mut count) = (0.0, 0usize);
        for height_m in map.levels[0].heights_m.iter().filter(|h| !h.is_nan()) {
            sum_m += f64::from(*height_m);
            count += 1;
        }
        let copies = map.levels.iter().map(copies).collect();
        MapGround { map: map.clone(), copies, mean_height_m: sum_m / count.max(1) as f64 }
    }

    pub(super) fn level(&self, index: usize) -> &MapLevel {
        &self.map.levels[index]
    }

    /// Mean height of the finest level, m.
    pub(super) fn mean_height_m(&self) -> f64 {
        self.mean_height_m
    }

    /// The level whose pixels are nearest to a footprint (m) but not larger, of those that know a place (x, y); the finest
    /// of those if all are larger. With the height there, m.
    pub(super) fn height_m(&self, place_m: &Vector2<f64>, footprint_m: f64) -> Option<(usize, f64)> {
        let coarsest = self.map.levels.iter().rposition(|l| l.metres_per_px <= footprint_m).unwrap_or(0);
        let known = |index: usize| Some((index, self.map.levels[index].height_m(place_m)?));
        (0..=coarsest).rev().find_map(known).or_else(|| (coarsest + 1..self.map.levels.len()).find_map(known))
    }

    /// Where a ray from above meets the ground. `direction` is as long as one unit of depth; a pixel spans
    /// `pixel_tangent` times the depth; the search starts at the height `from_m`. `None` off the map.
    pub(super) fn meet(
        &self,
        (origin_m, direction): (&Vector3<f64>, &Vector3<f64>),
        pixel_tangent: f64,
        from_m: f64,
    ) -> Option<Meeting> {
        let mut height_m = from_m;
        let mut last = None;
        // Height and how far the ground lies above it, at the step before.
        let mut before: Option<(f64, f64)> = None;
        for _ in 0..MOST_STEPS {
            let depth = (height_m - origin_m.z) / direction.z;
            if !(depth > 0.0 && depth.is_finite()) {
                return None;
            }
            let point_m = origin_m + direction * depth;
            let footprint_m = depth * pixel_tangent;
            let (level, ground_m) = self.height_m(&point_m.xy(), footprint_m)?;
            let above_m = ground_m - point_m.z;
            let off = above_m.abs() / footprint_m;
            last = Some((Meeting { point_in_site_m: point_m, level, footprint_m }, off));
            if off < SETTLED {
                break;
            }
            let slope = before.map_or(-1.0, |(z_m, a_m)| (above_m - a_m) / (height_m - z_m));
            before = Some((height_m, above_m));
            // A secant where it is near that of level ground, the ground's own height elsewhere.
            height_m = if (-2.0..-0.4).contains(&slope) { height_m - above_m / slope } else { ground_m };
        }
        last.filter(|(_, off)| *off < NEAR).map(|(meeting, _)| meeting)
    }

    /// Brightness of the ground about a meeting, averaged over its footprint; `None` where it is not known.
    pub(super) fn brightness(&self, meeting: &Meeting) -> Option<f32> {
        let level = &self.map.levels[meeting.level];
        let copies = &self.copies[meeting.level];
        let at = level.pixel_of(&meeting.point_in_site_m.xy());
        let halvings = (meeting.footprint_m / level.metres_per_px).log2().clamp(0.0, (copies.len() - 1) as f64);
        let (finer, share) = (halvings.floor() as usize, halvings.fract() as f32);
        let fine = copies[finer].at(&at, finer)?;
        let coarse = if share > 0.0 { copies[finer + 1].at(&at, finer + 1)? } else { fine };
        Some(fine + share * (coarse - fine))
    }
}

fn copies(level: &MapLevel) -> Vec<Copy> {
    let (width, height) = level.size_px();
    let known = level.heights_m.iter().map(|h| !h.is_nan());
    let scale = 1.0 / f32::from(u16::MAX);
    let grey = level.image.iter().zip(known).map(|(n, known)| if known { f32::from(*n) * scale } else { f32::NAN });
    let mut copies = vec![Copy { width: width as usize, height: height as usize, brightness: grey.collect() }];
    while copies[copies.len() - 1].width.min(copies[copies.len() - 1].height) >= 32 {
        copies.push(copies[copies.len() - 1].halved());
    }
    copies
}

impl Copy {
    /// Each pixel the mean of four.
    fn halved(&self) -> Copy {
        let (width, height) = (self.width / 2, self.height / 2);
        let mut brightness = Vec::with_capacity(width * height);
        for row in 0..height {
            let (upper, lower) = (2 * row * self.width, (2 * row + 1) * self.width);
            let four = |c: usize| [upper + 2 * c, upper + 2 * c + 1, lower + 2 * c, lower + 2 * c + 1];
            brightness.extend((0..width).map(|c| four(c).iter().map(|k| self.brightness[*k]).sum::<f32>() * 0.25));
        }
        Copy { width, height, brightness }
    }

    /// Bilinear value at a pixel of the level, of which this is the copy after so many halvings.
    fn at(&self, level_px: &Vector2<f64>, halvings: usize) -> Option<f32> {
        let scale = 0.5f64.powi(halvings as i32);
        let (u, v) = ((level_px.x + 0.5) * scale - 0.5, (level_px.y + 0.5) * scale - 0.5);
        let (last_u, last_v) = ((self.width - 1) as f64, (self.height - 1) as f64);
        if !(u >= -0.5 && v >= -0.5 && u <= last_u + 0.5 && v <= last_v + 0.5) {
            return None;
        }
        let (u, v) = (u.clamp(0.0, last_u), v.clamp(0.0, last_v));
        let (column, row) = ((u as usize).min(self.width - 2), (v as usize).min(self.height - 2));
        let (s, t) = ((u - column as f64) as f32, (v - row as f64) as f32);
        let first = row * self.width + column;
        let along = |k: usize| self.brightness[k] * (1.0 - s) + self.brightness[k + 1] * s;
        let mixed = along(first) * (1.0 - t) + along(first + self.width) * t;
        (!mixed.is_nan()).then_some(mixed)
    }
}
