//! IMU samples: `imu0/data.csv` and `imu0/sensor.yaml`.

use super::error::DatasetError;
use super::storage::{read_timed_table, write_text, write_timed_table};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// One measurement of an inertial measurement unit. The value at `t_ns` is the mean over the sample interval that ends
/// at `t_ns` (the way an integrating unit reports).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImuSample {
    /// End of the sample interval in ns.
    pub t_ns: i64,
    /// Angular rate of the lander in lander axes, rad/s.
    pub rate_in_lander_rad_s: Vector3<f64>,
    /// Specific force (acceleration less gravity) in lander axes, m/s².
    pub specific_force_in_lander_m_s2: Vector3<f64>,
}

/// White-noise densities and rate of an IMU, with EuRoC's key names.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ImuNoise {
    /// Samples a second.
    pub rate_hz: f64,
    /// Gyroscope white noise, rad/s/√Hz.
    pub gyroscope_noise_density: f64,
    /// Accelerometer white noise, m/s²/√Hz.
    pub accelerometer_noise_density: f64,
    /// How the biases wander, where the file says so.
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub bias: Option<ImuBiasNoise>,
}

/// How the biases of an IMU wander, with EuRoC's key names.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ImuBiasNoise {
    /// White noise that drives the gyroscope's bias, rad/s²/√Hz.
    pub gyroscope_random_walk: f64,
    /// White noise that drives the accelerometer's bias, m/s³/√Hz.
    pub accelerometer_random_walk: f64,
    /// Time constant in s with which both biases return to 0 (first-order Gauss-Markov); a random walk if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bias_time_constant_s: Option<f64>,
}

const HEADER: &str = "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],\
a_RS_S_x [m s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]";

/// Reads `imu0/data.csv` under a data set's root, and the unit's noise.
///
/// # Errors
/// Names the file and line at fault.
pub fn read_imu(root: &Path) -> Result<(ImuNoise, Vec<ImuSample>), DatasetError> {
    let table = read_timed_table(&root.join("imu0/data.csv"), 6)?;
    let sample = |row: &super::storage::TimedRow| ImuSample {
        t_ns: row.t_ns,
        rate_in_lander_rad_s: Vector3::from_column_slice(&row.values[..3]),
        specific_force_in_lander_m_s2: Vector3::from_column_slice(&row.values[3..]),
    };
    let sensor_path = root.join("imu0/sensor.yaml");
    let text = super::storage::read_text(&sensor_path)?;
    let noise: ImuNoise = serde_yaml_ng::from_str(&text)
        .map_err(|e| DatasetError::Unusable { path: sensor_path.clone(), problem: e.to_string() })?;
    let in_range = [noise.rate_hz, noise.gyroscope_noise_density, noise.accelerometer_noise_density]
        .iter()
        .all(|v| v.is_finite() && *v > 0.0);
    if !in_range {
        let problem = "rate_hz and both noise densities must be positive numbers".into();
        return Err(DatasetError::Unusable { path: sensor_path, problem });
    }
    Ok((noise, table.rows.iter().map(sample).collect()))
}

/// Writes `imu0/data.csv` under a data set's root.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_imu(root: &Path, samples: &[ImuSample]) -> Result<(), DatasetError> {
    let rows: Vec<(i64, [f64; 6])> = samples
        .iter()
        .map(|s| {
            let (w, a) = (s.rate_in_lander_rad_s, s.specific_force_in_lander_m_s2);
            (s.t_ns, [w.x, w.y, w.z, a.x, a.y, a.z])
        })
        .collect();
    write_timed_table(&root.join("imu0/data.csv"), HEADER, rows.iter().map(|(t, v)| (*t, v.as_slice())))
}

/// Writes `imu0/sensor.yaml` under a data set's root.
///
/// # Errors
/// [`DatasetError::Io`] with the path.
pub fn write_imu_sensor(root: &Path, noise: &ImuNoise) -> Result<(), DatasetError> {
    let path = root.join("imu0/sensor.yaml");
    let body = serde_yaml_ng::to_string(noise)
        .map_err(|e| DatasetError::Unusable { path: path.clone(), problem: e.to_string() })?;
    write_text(&path, &format!("sensor_type: imu\n{body}"))
}
