//! Camera files: `cam0/sensor.yaml`, with EuRoC's keys.

use crate::dataset::error::DatasetError;
use crate::dataset::storage::write_text;
use crate::geometry::{Camera, Distortion};
use nalgebra::{Isometry3, Matrix3, Matrix4, Rotation3, Translation3, UnitQuaternion, Vector2};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// A camera, how it is mounted, and how often it takes an image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CameraSensor {
    /// Intrinsic parameters.
    pub camera: Camera,
    /// Pose of the camera in the spacecraft's frame (`T_BS`), m.
    pub spacecraft_from_camera: Isometry3<f64>,
    /// Nominal images a second, where the file says so.
    pub rate_hz: Option<f64>,
    /// Bits a pixel that the images' numbers use, 1 to 16; all bits of their files if `None`.
    pub bits: Option<u32>,
}

#[derive(Serialize, Deserialize)]
struct CameraFile {
    resolution: [u32; 2],
    intrinsics: [f64; 4],
    #[serde(default)]
    distortion_model: Option<String>,
    #[serde(default)]
    distortion_coefficients: Vec<f64>,
    #[serde(rename = "T_BS", default)]
    t_bs: Option<MatrixFile>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    rate_hz: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    bits: Option<u32>,
}

#[derive(Serialize, Deserialize)]
struct MatrixFile {
    cols: u32,
    rows: u32,
    data: Vec<f64>,
}

/// Reads a camera file.
///
/// # Errors
/// Names the file and the key at fault.
pub fn read_camera_sensor(path: &Path) -> Result<CameraSensor, DatasetError> {
    if !path.exists() {
        let cure = "name a camera file with --camera sensor.yaml, or give the field of view with --fov-deg".into();
        return Err(DatasetError::Missing { path: path.into(), cure });
    }
    let text = crate::dataset::storage::read_text(path)?;
    let unusable = |problem: String| DatasetError::Unusable { path: path.into(), problem };
    // OpenCV writes a `%YAML:1.0` line that YAML itself does not know.
    let body: String = text.lines().filter(|l| !l.starts_with('%')).map(|l| format!("{l}\n")).collect();
    let file: CameraFile = serde_yaml_ng::from_str(&body).map_err(|e| unusable(e.to_string()))?;
    let camera = Camera {
        width_px: file.resolution[0],
        height_px: file.resolution[1],
        focal_px: Vector2::new(file.intrinsics[0], file.intrinsics[1]),
        center_px: Vector2::new(file.intrinsics[2], file.intrinsics[3]),
        distortion: distortion(&file).map_err(unusable)?,
    };
    camera.validate().map_err(|e| unusable(e.to_string()))?;
    if file.rate_hz.is_some_and(|rate| !(rate > 0.0 && rate.is_finite())) {
        return Err(unusable("rate_hz must be a positive number".into()));
    }
    if file.bits.is_some_and(|bits| !(1..=16).contains(&bits)) {
        return Err(unusable("bits must be a whole number from 1 to 16".into()));
    }
    let spacecraft_from_camera = match &file.t_bs {
        Some(matrix) => isometry(matrix).map_err(unusable)?,
        None => Isometry3::identity(),
    };
    Ok(CameraSensor { camera, spacecraft_from_camera, rate_hz: file.rate_hz, bits: file.bits })
}

fn distortion(file: &CameraFile) -> Result<Distortion, String> {
    let model = file.distortion_model.as_deref().unwrap_or("none");
    let four = || -> Result<[f64; 4], String> {
        let coefficients = &file.distortion_coefficients;
        let four: [f64; 4] = coefficients.as_slice().try_into().map_err(|_| {
            format!("distortion_coefficients has {} numbers, and the model {model} takes 4", coefficients.len())
        })?;
        if four.iter().any(|c| !c.is_finite()) {
            return Err("distortion_coefficients holds a value that is not a finite number".into());
        }
        Ok(four)
    };
    match model {
        "none" => Ok(Distortion::None),
        "radial-tangential" | "radtan" | "plumb_bob" => Ok(Distortion::RadialTangential(four()?)),
        "equidistant" | "kannala-brandt" => Ok(Distortion::Equidistant(four()?)),
        other => Err(format!("distortion_model '{other}' is not one of none, radial-tangential, equidistant")),
    }
}

fn isometry(matrix: &MatrixFile) -> Result<Isometry3<f64>, String> {
    if matrix.data.len() != 16 {
        return Err(format!("T_BS has {} numbers, 16 expected", matrix.data.len()));
    }
    if matrix.data.iter().any(|v| !v.is_finite()) {
        return Err("T_BS holds a value that is not a finite number".into());
    }
    let m = Matrix4::from_row_slice(&matrix.data);
    let rotation: Matrix3<f64> = m.fixed_view::<3, 3>(0, 0).into_owned();
    let off = (rotation * rotation.transpose() - Matrix3::identity()).abs().max();
    if off > 1e-3 || rotation.determinant() < 0.0 {
        return Err("the upper-left 3x3 block of T_BS is not a rotation".into());
    }
    let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix(&rotation));
    Ok(Isometry3::from_parts(Translation3::new(m[(0, 3)], m[(1, 3)], m[(2, 3)]), rotation))
}

/// Writes a camera file.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_camera_sensor(path: &Path, sensor: &CameraSensor) -> Result<(), DatasetError> {
    let camera = &sensor.camera;
    let (model, coefficients) = match camera.distortion {
        Distortion::None => ("none", vec![]),
        Distortion::RadialTangential(k) => ("radial-tangential", k.to_vec()),
        Distortion::Equidistant(k) => ("equidistant", k.to_vec()),
    };
    let matrix = sensor.spacecraft_from_camera.to_homogeneous();
    let file = CameraFile {
        resolution: [camera.width_px, camera.height_px],
        intrinsics: [camera.focal_px.x, camera.focal_px.y, camera.center_px.x, camera.center_px.y],
        distortion_model: Some(model.into()),
        distortion_coefficients: coefficients,
        t_bs: Some(MatrixFile { cols: 4, rows: 4, data: matrix.transpose().as_slice().to_vec() }),
        rate_hz: sensor.rate_hz,
        bits: sensor.bits,
    };
    let body = serde_yaml_ng::to_string(&file)
        .map_err(|e| DatasetError::Unusable { path: path.into(), problem: e.to_string() })?;
    write_text(path, &format!("sensor_type: camera\ncamera_model: pinhole\n{body}"))
}
