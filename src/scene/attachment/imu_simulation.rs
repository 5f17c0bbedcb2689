//! The inertial measurement unit of a node: white noise, and biases that wander.

use super::node_motion::NodeMotion;
use crate::dataset::truth::LanderState;
use crate::dataset::{ImuBiasNoise, ImuNoise, ImuSample};
use crate::scene::ideal::ideal_samples;
use crate::settings::{OutOfRange, limits};
use crate::stats::random_stream;
use nalgebra::Vector3;
use rand::Rng;
use rand_distr::{Distribution, StandardNormal};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An inertial measurement unit. Each axis of a bias is a first-order Gauss-Markov process.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct NodeImuConfig {
    /// Samples a second, a divisor of 10⁹ (default 10).
    pub rate_hz: u32,
    /// Gyroscope white noise in rad/s/√Hz (default 1.4544e-5: 0.05 °/√h).
    pub gyroscope_noise_density: f64,
    /// Accelerometer white noise in m/s²/√Hz (default 1e-4).
    pub accelerometer_noise_density: f64,
    /// 1σ of the gyroscope's bias in rad/s an axis (default 4.8481e-6: 1 °/h).
    pub gyroscope_bias_rad_s: f64,
    /// 1σ of the accelerometer's bias in m/s² an axis (default 1e-4).
    pub accelerometer_bias_m_s2: f64,
    /// Time constant of both biases in s (default 2000).
    pub bias_time_s: f64,
    /// Whether noise and biases are added (default true); the figures stand in the data set either way.
    pub noise: bool,
}

impl Default for NodeImuConfig {
    fn default() -> Self {
        NodeImuConfig {
            rate_hz: 10,
            gyroscope_noise_density: 0.05_f64.to_radians() / 60.0,
            accelerometer_noise_density: 1e-4,
            gyroscope_bias_rad_s: 1.0_f64.to_radians() / 3600.0,
            accelerometer_bias_m_s2: 1e-4,
            bias_time_s: 2000.0,
            noise: true,
        }
    }
}

impl NodeImuConfig {
    /// Time between samples in ns.
    pub fn interval_ns(&self) -> i64 {
        1_000_000_000 / i64::from(self.rate_hz)
    }

    /// The unit's data sheet. A Gauss-Markov process of 1σ b and time constant τ is driven by white noise of density
    /// b √(2/τ).
    pub fn noise(&self) -> ImuNoise {
        let root = (2.0 / self.bias_time_s).sqrt();
        ImuNoise {
            rate_hz: f64::from(self.rate_hz),
            gyroscope_noise_density: self.gyroscope_noise_density,
            accelerometer_noise_density: self.accelerometer_noise_density,
            bias: Some(ImuBiasNoise {
                gyroscope_random_walk: self.gyroscope_bias_rad_s * root,
                accelerometer_random_walk: self.accelerometer_bias_m_s2 * root,
                bias_time_constant_s: Some(self.bias_time_s),
            }),
        }
    }

    /// Samples up to `end_ns` with seeded noise, and the true states at t = 0 and at every sample with the true biases.
    pub fn samples(
        &self,
        motion: &NodeMotion,
        end_ns: i64,
        (seed, node): (u64, u32),
    ) -> (Vec<ImuSample>, Vec<LanderState>) {
        let mut samples = ideal_samples(motion, self.interval_ns(), end_ns);
        let mut states = vec![motion.state(0)];
        states.extend(samples.iter().map(|sample| motion.state(sample.t_ns)));
        if self.noise {
            self.disturb(&mut samples, &mut states, &mut random_stream(seed, "node-imu", u64::from(node)));
        }
        (samples, states)
    }

    fn disturb(&self, samples: &mut [ImuSample], states: &mut [LanderState], random: &mut impl Rng) {
        let dt_s = self.interval_ns() as f64 * 1e-9;
        let kept = (-dt_s / self.bias_time_s).exp();
        let fresh = (1.0 - kept * kept).sqrt();
        let root_rate = f64::from(self.rate_hz).sqrt();
        let mut gyro_bias = white(random) * self.gyroscope_bias_rad_s;
        let mut accelerometer_bias = white(random) * self.accelerometer_bias_m_s2;
        let note = |state: &mut LanderState, gyro: &Vector3<f64>, accelerometer: &Vector3<f64>| {
            (state.gyro_bias_rad_s, state.accelerometer_bias_m_s2) = (*gyro, *accelerometer);
        };
        note(&mut states[0], &gyro_bias, &accelerometer_bias);
        for (sample, state) in samples.iter_mut().zip(&mut states[1..]) {
            gyro_bias = gyro_bias * kept + white(random) * (fresh * self.gyroscope_bias_rad_s);
            accelerometer_bias = accelerometer_bias * kept + white(random) * (fresh * self.accelerometer_bias_m_s2);
            note(state, &gyro_bias, &accelerometer_bias);
            sample.rate_in_lander_rad_s += gyro_bias + white(random) * (self.gyroscope_noise_density * root_rate);
            sample.specific_force_in_lander_m_s2 +=
                accelerometer_bias + white(random) * (self.accelerometer_noise_density * root_rate);
        }
    }

    /// Checks every setting's range.
    ///
    /// # Errors
    /// Names the first key outside its range.
    pub fn validate(&self) -> Result<(), OutOfRange> {
        if self.rate_hz == 0 || 1_000_000_000 % self.rate_hz != 0 || self.rate_hz > 10_000 {
            let cure = "it must divide 1000000000 and be at most 10000, such as 10, 50, 100";
            return Err(OutOfRange::new("rate_hz", self.rate_hz, cure));
        }
        limits::positive("gyroscope_noise_density", self.gyroscope_noise_density)?;
        limits::positive("accelerometer_noise_density", self.accelerometer_noise_density)?;
        limits::positive("gyroscope_bias_rad_s", self.gyroscope_bias_rad_s)?;
        limits::positive("accelerometer_bias_m_s2", self.accelerometer_bias_m_s2)?;
        limits::positive("bias_time_s", self.bias_time_s)
    }
}

fn white(random: &mut impl Rng) -> Vector3<f64> {
    Vector3::from_fn(|_, _| StandardNormal.sample(random))
}
