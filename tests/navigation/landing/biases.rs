//! Biases of the inertial unit are estimated.

use super::descent::normal3;
use super::flight::{FLIGHT, fly};
use super::flown::{last_of, mean, nees};
use nalgebra::Vector3;
use opnav::navigation::landing::{BiasPrior, LandingConfig, LandingInput};
use opnav::stats::{ConsistencyBounds, random_stream};

/// The same flight with an IMU that measures too much by constant biases.
pub fn biased(mut input: LandingInput, run: u64) -> (LandingInput, Vector3<f64>, Vector3<f64>) {
    let mut random = random_stream(11, "biases", run);
    let gyroscope_rad_s = normal3(&mut random, GYRO_SIGMA_RAD_S);
    let accelerometer_m_s2 = normal3(&mut random, FORCE_SIGMA_M_S2);
    for sample in &mut input.imu {
        sample.rate_in_lander_rad_s += gyroscope_rad_s;
        sample.specific_force_in_lander_m_s2 += accelerometer_m_s2;
    }
    (input, gyroscope_rad_s, accelerometer_m_s2)
}

pub const GYRO_SIGMA_RAD_S: f64 = 2e-5;

pub const FORCE_SIGMA_M_S2: f64 = 3e-3;

/// With the biases in the state the filter is consistent, finds what the motion shows of them, and lands; without them
/// it is not.
#[test]
fn biases_are_estimated() {
    let flown: Vec<_> = (0..12u64).map(|run| biased(fly(&FLIGHT, run), run)).collect();
    let inputs: Vec<_> = flown.iter().map(|f| f.0.clone()).collect();
    let prior = BiasPrior { sigma_gyroscope_rad_s: GYRO_SIGMA_RAD_S, sigma_accelerometer_m_s2: FORCE_SIGMA_M_S2 };
    let knowing = LandingConfig { biases: Some(prior), unknown_landmarks: 3, ..LandingConfig::default() };
    let ignorant = LandingConfig { biases: None, ..knowing.clone() };
    let bounds = ConsistencyBounds::of_mean(9, inputs.len(), 0.999);
    let last = last_of(&inputs, &knowing);
    assert!(bounds.contains(mean(&last, nees)), "NEES {}", mean(&last, nees));
    assert!(mean(&last_of(&inputs, &ignorant), nees) > 3.0 * bounds.upper);
    let mut normalized = 0.0;
    for (epoch, (_, gyroscope, accelerometer)) in last.iter().zip(&flown) {
        let (biases, sigma) = epoch.biases.expect("estimated");
        for k in 0..3 {
            normalized += ((biases.gyroscope_rad_s - gyroscope)[k] / sigma[k]).powi(2);
            normalized += ((biases.accelerometer_m_s2 - accelerometer)[k] / sigma[3 + k]).powi(2);
        }
        // The vertical one is seen in the motion.
        assert!(sigma[5] < 0.4 * FORCE_SIGMA_M_S2, "{sigma:?}");
    }
    let per_bias = normalized / (6 * last.len()) as f64;
    assert!((0.5..1.6).contains(&per_bias), "{per_bias}");
}
