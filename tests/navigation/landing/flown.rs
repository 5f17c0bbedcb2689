//! Simulated flights navigated, and how far off they are.

use super::flight::truth_at_ns;
use nalgebra::SVector;
use opnav::navigation::landing::{LandingConfig, LandingEpoch, LandingInput, LandingResult, navigate};
use opnav::stats::normalized_error_squared;
use rayon::prelude::*;

pub fn error(epoch: &LandingEpoch) -> SVector<f64, 9> {
    truth_at_ns(epoch.t_ns).error_of(&epoch.site_from_lander, &epoch.lander_velocity_in_site_m_s)
}

pub fn nees(epoch: &LandingEpoch) -> f64 {
    normalized_error_squared(&error(epoch), &epoch.covariance).expect("a positive definite covariance") / 9.0
}

pub fn land(input: &LandingInput, config: &LandingConfig) -> LandingResult {
    navigate(input, config, &|_| ()).expect("a navigable descent")
}

/// The epoch of the last frame.
pub fn last_frame(input: &LandingInput, result: &LandingResult) -> LandingEpoch {
    result.epochs[input.frame_times_ns.len() - 1].clone()
}

/// The last epoch with an image of every flight.
pub fn last_of(inputs: &[LandingInput], config: &LandingConfig) -> Vec<LandingEpoch> {
    inputs.par_iter().map(|input| land(input, config).epochs.swap_remove(input.frame_times_ns.len() - 1)).collect()
}

pub fn mean(epochs: &[LandingEpoch], of: impl Fn(&LandingEpoch) -> f64) -> f64 {
    epochs.iter().map(of).sum::<f64>() / epochs.len() as f64
}
