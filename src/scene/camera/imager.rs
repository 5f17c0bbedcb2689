//! What takes an image.

use super::config::CameraConfig;
use crate::dataset::{CameraId, CameraSensor};
use crate::geometry::{Camera, so3};
use crate::scene::sensor::SensorConfig;
use crate::scene::view::View;
use crate::settings::OutOfRange;
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use schemars::JsonSchema;

/// A camera of a scenario with its detector: the tables `[camera]` and `[sensor]`, or one entry of `[[cameras]]`.
#[derive(Debug, Clone, PartialEq, Default, JsonSchema)]
pub struct ImagerConfig {
    /// The camera.
    #[schemars(flatten)]
    pub camera: CameraConfig,
    /// The detector, instead of the table `[sensor]` (default: that table).
    #[schemars(with = "Option<SensorConfig>")]
    pub sensor: SensorConfig,
}

impl ImagerConfig {
    /// What the settings describe.
    pub fn imager(&self) -> Imager {
        Imager {
            camera: self.camera.camera(),
            detector: self.sensor,
            nominal_from_camera: so3::exp(&Vector3::from(self.camera.turn_deg).map(f64::to_radians)),
            offset_in_spacecraft_m: self.camera.offset_m.into(),
        }
    }

    /// Checks every setting's range; `index` is the entry in `[[cameras]]`, `None` for the tables `[camera]` and `[sensor]`.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self, index: Option<usize>) -> Result<(), OutOfRange> {
        let entry = index.map(|index| format!("cameras[{index}]"));
        self.camera.validate().map_err(|e| e.under(entry.as_deref().unwrap_or("camera")))?;
        let sensor = self.sensor.validate().map_err(|e| e.under("sensor"));
        sensor.map_err(|e| entry.iter().fold(e, |e, entry| e.under(entry)))
    }
}

/// A camera with its detector, and how it stands apart from the mission's nominal camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Imager {
    /// Intrinsic parameters.
    pub camera: Camera,
    /// The detector.
    pub detector: SensorConfig,
    /// Rotation from camera axes to those of the nominal camera.
    pub nominal_from_camera: UnitQuaternion<f64>,
    /// From the nominal camera's place to the camera's, in spacecraft axes, m.
    pub offset_in_spacecraft_m: Vector3<f64>,
}

impl Imager {
    /// Pose of the camera in spacecraft axes (m), given that of the mission's nominal camera.
    pub fn spacecraft_from_camera(&self, spacecraft_from_nominal: &Isometry3<f64>) -> Isometry3<f64> {
        let place_m = spacecraft_from_nominal.translation.vector + self.offset_in_spacecraft_m;
        let rotation = spacecraft_from_nominal.rotation * self.nominal_from_camera;
        Isometry3::from_parts(Translation3::from(place_m), rotation)
    }
}

/// A camera of a scene and the images that it takes.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneCamera {
    /// Its name in the data set.
    pub id: CameraId,
    /// Its parameters and its place on the spacecraft.
    pub sensor: CameraSensor,
    /// Its detector.
    pub detector: SensorConfig,
    /// One view an image, times increasing.
    pub views: Vec<View>,
}
