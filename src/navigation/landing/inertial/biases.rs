//! Biases of the inertial sensors.

use nalgebra::Vector3;

/// Biases of an inertial measurement unit: what it measures too much, lander axes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ImuBiases {
    /// Bias of the gyroscope, rad/s.
    pub gyroscope_rad_s: Vector3<f64>,
    /// Bias of the accelerometer, m/s².
    pub accelerometer_m_s2: Vector3<f64>,
}
