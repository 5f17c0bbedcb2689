//! Landings from simulated tracks against their bounds.

use super::flight::{FLIGHT, fly};
use super::flown::{error, land, last_frame, nees};
use opnav::navigation::landing::{LandingConfig, LandingEpoch};
use opnav::navigation::landmark::Selector;
use rayon::prelude::*;

/// Prints errors from pixels: `cargo test --test main accuracy_of_simulated_flights -- --ignored --nocapture`.
#[test]
#[ignore = "prints a table of 40 flights a row"]
fn accuracy_of_simulated_flights() {
    let flights: Vec<_> = (0..40u64).into_par_iter().map(|run| fly(&FLIGHT, run)).collect();
    println!("rms at the last image | horizontal m | z m | v m/s | tilt ° | NEES");
    for (selector, unknown_landmarks, reselect_after) in [
        (Selector::None, 1, 3),
        (Selector::DepthError, 1, 3),
        (Selector::Svd, 1, 3),
        (Selector::Random, 1, 3),
        (Selector::Covariance, 1, 3),
        (Selector::DepthError, 3, 8),
        (Selector::DepthError, 8, 8),
    ] {
        let config = LandingConfig { selector, unknown_landmarks, reselect_after, ..LandingConfig::default() };
        let last: Vec<LandingEpoch> =
            flights.par_iter().map(|input| last_frame(input, &land(input, &config))).collect();
        let rms = |start: usize, size: usize| {
            let square = |e: &LandingEpoch| error(e).rows(start, size).norm_squared();
            (last.iter().map(square).sum::<f64>() / last.len() as f64).sqrt()
        };
        let nees = last.iter().map(nees).sum::<f64>() / last.len() as f64;
        let (h, z, v, tilt) = (rms(0, 2), rms(2, 1), rms(3, 3), rms(6, 2).to_degrees());
        println!(
            "{selector:?} {unknown_landmarks}x{reselect_after} | {h:.3} | {z:.3} | {v:.3} | {tilt:.4} | {nees:.2}"
        );
    }
}
