//! What an integrating inertial measurement unit reports on a descent.

use super::motion::DescentMotion;
use crate::dataset::{ImuNoise, ImuSample};
use crate::scene::ideal::ideal_samples;
use crate::settings::{OutOfRange, limits};
use crate::stats::random_stream;
use nalgebra::Vector3;
use rand_distr::{Distribution, StandardNormal};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An inertial measurement unit with white noise and no bias.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ImuConfig {
    /// Samples a second, a divisor of 10⁹ (default 100).
    pub rate_hz: u32,
    /// Gyroscope white noise in rad/s/√Hz (default 4.852e-7: 2.78e-5 °/s over 1 s).
    pub gyroscope_noise_density: f64,
    /// Accelerometer white noise in m/s²/√Hz (default 5e-4).
    pub accelerometer_noise_density: f64,
    /// Whether noise is added (default true); the densities stand in the data set either way.
    pub noise: bool,
}

impl Default for ImuConfig {
    fn default() -> Self {
        ImuConfig {
            rate_hz: 100,
            gyroscope_noise_density: 2.78e-5_f64.to_radians(),
            accelerometer_noise_density: 5e-4,
            noise: true,
        }
    }
}

impl ImuConfig {
    /// Time between samples in ns.
    pub fn interval_ns(&self) -> i64 {
        1_000_000_000 / i64::from(self.rate_hz)
    }

    /// The unit's data sheet.
    pub fn noise(&self) -> ImuNoise {
        ImuNoise {
            rate_hz: f64::from(self.rate_hz),
            gyroscope_noise_density: self.gyroscope_noise_density,
            accelerometer_noise_density: self.accelerometer_noise_density,
            bias: None,
        }
    }

    /// Samples at the end of each interval up to `end_ns`, with seeded noise: 1σ of a sample is density · √rate.
    pub fn samples(&self, motion: &DescentMotion, end_ns: i64, seed: u64) -> Vec<ImuSample> {
        let mut samples = ideal_samples(motion, self.interval_ns(), end_ns);
        if self.noise {
            let mut random = random_stream(seed, "imu", 0);
            let mut white = |sigma: f64| {
                let draw: [f64; 3] = std::array::from_fn(|_| StandardNormal.sample(&mut random));
                Vector3::from(draw) * sigma
            };
            let root_rate = f64::from(self.rate_hz).sqrt();
            for sample in &mut samples {
                sample.rate_in_lander_rad_s += white(self.gyroscope_noise_density * root_rate);
                sample.specific_force_in_lander_m_s2 += white(self.accelerometer_noise_density * root_rate);
            }
        }
        samples
    }

    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        if self.rate_hz == 0 || 1_000_000_000 % self.rate_hz != 0 || self.rate_hz > 10_000 {
            let cure = "it must divide 1000000000 and be at most 10000, such as 50, 100, 200";
            return Err(OutOfRange::new("rate_hz", self.rate_hz, cure));
        }
        limits::positive("gyroscope_noise_density", self.gyroscope_noise_density)?;
        limits::positive("accelerometer_noise_density", self.accelerometer_noise_density)
    }
}
