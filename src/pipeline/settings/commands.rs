//! One type of settings a command that reads images.

use super::InputSettings;
use crate::navigation::landing::LandingConfig;
use crate::navigation::tumbling::TumblingConfig;
use crate::settings::{OutOfRange, Settings};
use crate::vision::{FrontEndConfig, FrontEndMode, MapMatchConfig};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use toml::Table;

/// Settings of `opnav track`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct TrackSettings {
    /// Which images are taken, and what is known of them.
    pub input: InputSettings,
    /// Features, matching, tracks and rotations.
    pub front_end: FrontEndConfig,
}

impl Settings for TrackSettings {
    fn validate(&self) -> Result<(), OutOfRange> {
        self.input.validate().map_err(|e| e.under("input"))?;
        self.front_end.validate().map_err(|e| e.under("front_end"))
    }
}

/// What a descent is navigated by besides its data set.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct LandInput {
    /// Folder of a map that gives known points, relative to the folder in which the command runs (default: none).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub map: Option<PathBuf>,
}

/// Settings of `opnav land`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct LandSettings {
    /// What is used besides the data set.
    pub input: LandInput,
    /// The landing filter.
    pub landing: LandingConfig,
    /// Features, matching, tracks and rotations.
    pub front_end: FrontEndConfig,
    /// Matching with the map, if there is one.
    pub map: MapMatchConfig,
}

impl Default for LandSettings {
    fn default() -> Self {
        LandSettings {
            input: LandInput::default(),
            landing: LandingConfig::from_pixels(),
            front_end: FrontEndConfig::default(),
            map: MapMatchConfig::default(),
        }
    }
}

impl Settings for LandSettings {
    fn validate(&self) -> Result<(), OutOfRange> {
        self.landing.validate().map_err(|e| e.under("landing"))?;
        self.front_end.validate().map_err(|e| e.under("front_end"))?;
        self.map.validate().map_err(|e| e.under("map"))
    }
}

/// Settings of `opnav tumble`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct TumbleSettings {
    /// Which images are taken, and what is known of them.
    pub input: InputSettings,
    /// The estimator of the motion.
    pub tumbling: TumblingConfig,
    /// Features, matching, tracks and rotations.
    pub front_end: FrontEndConfig,
}

impl Default for TumbleSettings {
    fn default() -> Self {
        TumbleSettings {
            input: InputSettings::default(),
            tumbling: TumblingConfig::default(),
            front_end: FrontEndConfig { mode: FrontEndMode::FixedCenter, ..FrontEndConfig::default() },
        }
    }
}

impl Settings for TumbleSettings {
    fn validate(&self) -> Result<(), OutOfRange> {
        self.input.validate().map_err(|e| e.under("input"))?;
        self.tumbling.validate().map_err(|e| e.under("tumbling"))?;
        self.front_end.validate().map_err(|e| e.under("front_end"))
    }
}

/// Settings of `opnav demo`: those of its stages, which take their images as they come.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct DemoSettings {
    /// Keys laid over the descent's scenario, such as `descent.camera.width_px` (default: none).
    #[serde(skip_serializing_if = "Table::is_empty")]
    #[schemars(with = "serde_json::Map<String, serde_json::Value>")]
    pub descent: Table,
    /// Keys laid over the asteroid's scenario, such as `asteroid.tumbling.frames` (default: none).
    #[serde(skip_serializing_if = "Table::is_empty")]
    #[schemars(with = "serde_json::Map<String, serde_json::Value>")]
    pub asteroid: Table,
    /// Tracking of the descent.
    pub track: TrackSettings,
    /// Navigation of the descent.
    pub land: LandSettings,
    /// Navigation about the asteroid; it is done a second time with the estimator `paper`.
    pub tumble: TumbleSettings,
}

impl Settings for DemoSettings {
    fn validate(&self) -> Result<(), OutOfRange> {
        self.track.validate().map_err(|e| e.under("track"))?;
        self.land.validate().map_err(|e| e.under("land"))?;
        self.tumble.validate().map_err(|e| e.under("tumble"))
    }
}
