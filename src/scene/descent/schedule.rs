//! When images are taken on a descent.

use super::guidance::PolynomialGuidance;
use crate::scene::error::SceneError;
use crate::settings::{OutOfRange, limits};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Times of the images. The last one is taken no lower than `end_height_m` above the site.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub enum FrameSchedule {
    /// At a constant rate.
    Uniform {
        /// Images a second, 0.0001 to 10000 (default 1).
        #[serde(default = "one")]
        rate_hz: f64,
        /// Time of the first image in s (default 0).
        #[serde(default)]
        start_s: f64,
        /// No image after this time in s (default 10000: until the end height).
        #[serde(default = "long")]
        end_s: f64,
        /// Height above the site below which no image is taken, in m, from 0.1 (default 15).
        #[serde(default = "fifteen")]
        end_height_m: f64,
    },
    /// The height above the site shrinks by the same ratio from each image to the next.
    ConstantScale {
        /// Number of images (default 60), the first at t = 0.
        #[serde(default = "sixty")]
        count: usize,
        /// Height above the site of the last image in m, from 0.1 (default 15).
        #[serde(default = "fifteen")]
        end_height_m: f64,
    },
}

fn one() -> f64 {
    1.0
}
fn long() -> f64 {
    10_000.0
}
fn fifteen() -> f64 {
    15.0
}
fn sixty() -> usize {
    60
}

impl Default for FrameSchedule {
    fn default() -> Self {
        FrameSchedule::Uniform { rate_hz: one(), start_s: 0.0, end_s: long(), end_height_m: fifteen() }
    }
}

impl FrameSchedule {
    /// Times of the images in ns, each rounded to a multiple of `grid_ns` (the inertial measurement unit's interval).
    ///
    /// # Errors
    /// Names the key at fault if the images lie closer than the grid, or there is none.
    pub fn times_ns(&self, path: &PolynomialGuidance, grid_ns: i64) -> Result<Vec<i64>, SceneError> {
        let on_grid = |t_s: f64| (t_s * 1e9 / grid_ns as f64).round() as i64 * grid_ns;
        let (times_ns, key, value): (Vec<i64>, _, _) = match *self {
            FrameSchedule::Uniform { rate_hz, start_s, end_s, end_height_m } => {
                let last_s = time_at_height_s(path, end_height_m).min(end_s);
                let count = ((last_s - start_s) * rate_hz + 1e-9).floor() + 1.0;
                let times = (0..count.max(0.0) as u64).map(|i| on_grid(start_s + i as f64 / rate_hz)).collect();
                (times, "uniform.rate_hz", rate_hz)
            }
            FrameSchedule::ConstantScale { count, end_height_m } => {
                let first_m = path.position_in_site_m(0.0).z;
                let height_m = |index: usize| {
                    let share = index as f64 / (count - 1).max(1) as f64;
                    first_m * (end_height_m / first_m).powf(share)
                };
                let times = (0..count).map(|i| on_grid(time_at_height_s(path, height_m(i)))).collect();
                (times, "constant-scale.count", count as f64)
            }
        };
        if times_ns.is_empty() {
            let cure = "no picture lies between the start and the end: change start_s, end_s or end_height_m";
            return Err(SceneError::out_of_range(key, value, cure));
        }
        if times_ns.windows(2).any(|w| w[1] <= w[0]) {
            let cure = "pictures would lie closer together than the samples of the inertial measurement unit: lower it";
            return Err(SceneError::out_of_range(key, value, cure));
        }
        Ok(times_ns)
    }

    /// Nominal images a second, if constant.
    pub fn rate_hz(&self) -> Option<f64> {
        match self {
            FrameSchedule::Uniform { rate_hz, .. } => Some(*rate_hz),
            FrameSchedule::ConstantScale { .. } => None,
        }
    }

    /// Checks every setting's range on a path.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self, path: &PolynomialGuidance) -> Result<(), OutOfRange> {
        let highest_m = path.position_in_site_m(0.0).z;
        match *self {
            FrameSchedule::Uniform { rate_hz, start_s, end_s, end_height_m } => {
                limits::within("uniform.rate_hz", rate_hz, 1e-4, 1e4)?;
                limits::within("uniform.start_s", start_s, 0.0, path.duration_s)?;
                limits::within("uniform.end_s", end_s, start_s, 1e6)?;
                limits::within("uniform.end_height_m", end_height_m, 0.1, highest_m)
            }
            FrameSchedule::ConstantScale { count, end_height_m } => {
                limits::count("constant-scale.count", count, 2, 100_000)?;
                limits::within("constant-scale.end_height_m", end_height_m, 0.1, 0.999 * highest_m)
            }
        }
    }
}

/// Last time in s at which the path is at least `height_m` above the site, by bisection; the path ends at height 0.
fn time_at_height_s(path: &PolynomialGuidance, height_m: f64) -> f64 {
    const COARSE: u32 = 2000;
    let at = |step: u32| path.duration_s * f64::from(step) / f64::from(COARSE);
    let above = |t_s: f64| path.position_in_site_m(t_s).z >= height_m;
    let Some(last) = (0..COARSE).rev().find(|step| above(at(*step))) else { return 0.0 };
    let (mut high_s, mut low_s) = (at(last), at(last + 1));
    for _ in 0..60 {
        let middle_s = 0.5 * (high_s + low_s);
        *(if above(middle_s) { &mut high_s } else { &mut low_s }) = middle_s;
    }
    high_s
}
