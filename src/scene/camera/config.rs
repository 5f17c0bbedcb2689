//! The camera of a scenario.

use crate::geometry::{Camera, CameraError, Distortion};
use crate::settings::{OutOfRange, limits};
use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A camera: resolution, focal length, principal point, lens distortion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct CameraConfig {
    /// Image width in px, 16 to 16384 (default 1024).
    pub width_px: u32,
    /// Image height in px, 16 to 16384 (default 1024).
    pub height_px: u32,
    /// Horizontal field of view in degrees of square pixels around a centred principal point, without distortion, 0.01
    /// to 170 (default 90 for a descent, 30 for a tumbling body and an attachment). It gives the focal length where
    /// `focal_px` does not.
    pub fov_deg: f64,
    /// Focal lengths along u and v in px, instead of `fov_deg`, 1 to 1e8 (default: from `fov_deg`).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub focal_px: Option<[f64; 2]>,
    /// Principal point (u, v) in px, pixel centres at integers, -100000 to 100000 (default: the middle of the image).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub center_px: Option<[f64; 2]>,
    /// Lens distortion (default none).
    pub distortion: DistortionConfig,
    /// Rotation vector in degrees that turns the camera away from the mission's nominal direction, in the nominal
    /// camera's axes: x right, y down, z forward, -180 to 180 (default 0, 0, 0).
    pub turn_deg: [f64; 3],
    /// Place of the camera less that of the mission's nominal camera, in spacecraft axes, m, -100 to 100 (default 0, 0,
    /// 0).
    pub offset_m: [f64; 3],
}

/// Lens distortion with OpenCV's coefficients.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct DistortionConfig {
    /// The model (default `none`).
    pub model: DistortionModel,
    /// `[k1, k2, p1, p2]` of `radial-tangential`, `[k1, k2, k3, k4]` of `equidistant` (default 0, 0, 0, 0).
    pub coefficients: [f64; 4],
}

/// Model of lens distortion; see [`Distortion`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum DistortionModel {
    /// A pinhole camera.
    #[default]
    None,
    /// Brown–Conrady.
    RadialTangential,
    /// Kannala–Brandt fisheye.
    Equidistant,
}

impl Default for CameraConfig {
    fn default() -> Self {
        CameraConfig {
            width_px: 1024,
            height_px: 1024,
            fov_deg: 90.0,
            focal_px: None,
            center_px: None,
            distortion: DistortionConfig::default(),
            turn_deg: [0.0; 3],
            offset_m: [0.0; 3],
        }
    }
}

impl CameraConfig {
    /// The camera's parameters.
    pub fn camera(&self) -> Camera {
        let pinhole = Camera::from_fov(self.width_px, self.height_px, self.fov_deg.to_radians());
        Camera {
            focal_px: self.focal_px.map_or(pinhole.focal_px, Vector2::from),
            center_px: self.center_px.map_or(pinhole.center_px, Vector2::from),
            distortion: self.distortion.distortion(),
            ..pinhole
        }
    }

    /// Checks every setting's range, and that every corner of the image can be undistorted.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::count("width_px", self.width_px as usize, 16, 16_384)?;
        limits::count("height_px", self.height_px as usize, 16, 16_384)?;
        limits::within("fov_deg", self.fov_deg, 0.01, 170.0)?;
        for focal_px in self.focal_px.into_iter().flatten() {
            limits::within("focal_px", focal_px, 1.0, 1e8)?;
        }
        for center_px in self.center_px.into_iter().flatten() {
            limits::within("center_px", center_px, -1e5, 1e5)?;
        }
        self.turn_deg.iter().try_for_each(|v| limits::within("turn_deg", *v, -180.0, 180.0))?;
        self.offset_m.iter().try_for_each(|v| limits::within("offset_m", *v, -100.0, 100.0))?;
        self.distortion.validate().map_err(|e| e.under("distortion"))?;
        self.camera().validate().map_err(|fault| self.unusable_lens(&fault))
    }

    fn unusable_lens(&self, fault: &CameraError) -> OutOfRange {
        let value = format!("{:?}", self.distortion.coefficients);
        OutOfRange::new("distortion.coefficients", value, fault)
    }
}

impl DistortionConfig {
    /// The lens distortion.
    pub fn distortion(&self) -> Distortion {
        match self.model {
            DistortionModel::None => Distortion::None,
            DistortionModel::RadialTangential => Distortion::RadialTangential(self.coefficients),
            DistortionModel::Equidistant => Distortion::Equidistant(self.coefficients),
        }
    }

    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        limits::finite("coefficients", &self.coefficients)?;
        if self.model == DistortionModel::None && self.coefficients != [0.0; 4] {
            let cure = "no model uses them: set distortion.model to radial-tangential or equidistant";
            return Err(OutOfRange::new("coefficients", format!("{:?}", self.coefficients), cure));
        }
        Ok(())
    }
}
