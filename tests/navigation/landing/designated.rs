//! The error of the designated pixel and its drift are in the covariance.

use super::flight::{FLIGHT, Flight, fly};
use super::flown::{error, land, last_frame, nees};
use opnav::navigation::landing::{LandingConfig, LandingEpoch};
use opnav::stats::ConsistencyBounds;
use rayon::prelude::*;

/// The designated pixel is off by some 0.5 px, which is 20 m of ground: with the option the covariance says so.
#[test]
fn designated_pixel_error_is_in_the_covariance() {
    let flight = Flight { designated_sigma_px: 0.5, ..FLIGHT };
    let flights: Vec<_> = (0..12u64).into_par_iter().map(|run| fly(&flight, run)).collect();
    let mean = |designated_sigma_px: f64| {
        let config = LandingConfig { designated_sigma_px, ..LandingConfig::default() };
        let each = flights.par_iter().map(|input| nees(&last_frame(input, &land(input, &config))));
        each.sum::<f64>() / flights.len() as f64
    };
    let bounds = ConsistencyBounds::of_mean(9, flights.len(), 0.999);
    assert!(bounds.contains(mean(0.5)), "NEES {}", mean(0.5));
    assert!(mean(0.0) > 100.0);
}

/// The tracker slips off the designated point by 0.15 px a frame, some 8 m in all: with the option the covariance says so.
#[test]
fn designated_drift_is_in_the_covariance() {
    let flight = Flight { designated_drift_px: 0.15, ..FLIGHT };
    let config = LandingConfig { designated_drift_px: 0.15, ..LandingConfig::default() };
    let last: Vec<LandingEpoch> = (0..16u64)
        .into_par_iter()
        .map(|run| {
            let input = fly(&flight, run);
            last_frame(&input, &land(&input, &config))
        })
        .collect();
    let mean = |f: &dyn Fn(&LandingEpoch) -> f64| last.iter().map(f).sum::<f64>() / last.len() as f64;
    let horizontal_m = mean(&|e| error(e).fixed_rows::<2>(0).norm_squared()).sqrt();
    assert!((2.0..20.0).contains(&horizontal_m), "{horizontal_m}");
    let bounds = ConsistencyBounds::of_mean(9, last.len(), 0.999);
    assert!(bounds.contains(mean(&nees)), "NEES {}, horizontal {horizontal_m} m", mean(&nees));
}
