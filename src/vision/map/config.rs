//! Parameters of the matching with a map.

use crate::settings::{OutOfRange, limits};
use crate::vision::config::FrontEndConfig;
use crate::vision::features::DetectorConfig;
use crate::vision::matching::MatcherConfig;
use crate::vision::noise_model::{MapNoise, NoiseModel, PatchNoise};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What finds and matches features of a map and of an image: the front end's settings. How many features, and how far off
/// the edge, the map decides itself.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MapFeatures {
    /// Detection.
    pub detector: DetectorConfig,
    /// Description and matching.
    pub matcher: MatcherConfig,
}

impl MapFeatures {
    /// The means of a front end.
    pub fn of(front_end: &FrontEndConfig) -> Self {
        MapFeatures { detector: front_end.detector.clone(), matcher: front_end.matcher.clone() }
    }
}

/// Matching of images with a map.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct MapMatchConfig {
    /// Images are halved until neither side is longer, px, 64 or more (default 512).
    pub max_side_px: u32,
    /// Images are halved, too, until a pixel on the ground is as large as this share of the map's finest pixel there,
    /// above 0 (default 0.6): the map does not know what is smaller.
    pub least_pixel_ratio: f64,
    /// Corners of the map that are looked for in an image, no fewer than `fewest_sightings` (default 100).
    pub candidates: usize,
    /// Most sightings given, spread over the image, no fewer than `fewest_sightings` (default 30): errors of near ones are
    /// alike.
    pub most_sightings: usize,
    /// Fewest sightings that agree with one pose; below, none is given, 4 or more (default 8).
    pub fewest_sightings: usize,
    /// Least share of the corners found that have to agree, 0 to 1 (default 0.5).
    pub least_agreeing: f64,
    /// Greatest predicted 1σ of a pixel, in px of the halved image, with which patches are looked for at once; beyond,
    /// the image is matched by descriptors first, above 0 (default 3).
    pub track_sigma_px: f64,
    /// How wrong the points are that are found (default: the noise model's).
    pub noise: MapNoise,
    /// How wrong the patches are by which they are found (default: the noise model's).
    pub patch_noise: PatchNoise,
}

impl Default for MapMatchConfig {
    fn default() -> Self {
        MapMatchConfig {
            max_side_px: 512,
            least_pixel_ratio: 0.6,
            candidates: 100,
            most_sightings: 30,
            fewest_sightings: 8,
            least_agreeing: 0.5,
            track_sigma_px: 3.0,
            noise: MapNoise::default(),
            patch_noise: PatchNoise::default(),
        }
    }
}

impl MapMatchConfig {
    /// The same settings with every constant of a noise model that concerns them.
    pub fn with_noise_model(mut self, model: &NoiseModel) -> Self {
        (self.noise, self.patch_noise) = (model.map, model.patch);
        self
    }

    /// Checks every range.
    ///
    /// # Errors
    /// Names the key.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::count_from("max_side_px", self.max_side_px as usize, 64)?;
        limits::positive("least_pixel_ratio", self.least_pixel_ratio)?;
        limits::count_from("fewest_sightings", self.fewest_sightings, 4)?;
        for (key, value) in [("candidates", self.candidates), ("most_sightings", self.most_sightings)] {
            if value < self.fewest_sightings {
                return Err(OutOfRange::new(key, value, "it must be no less than fewest_sightings"));
            }
        }
        limits::within("least_agreeing", self.least_agreeing, 0.0, 1.0)?;
        limits::positive("track_sigma_px", self.track_sigma_px)?;
        self.noise.validate().map_err(|e| e.under("noise"))?;
        self.patch_noise.validate().map_err(|e| e.under("patch_noise"))
    }
}
