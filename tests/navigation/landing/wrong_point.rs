//! The designated point leads to somewhere else for many images: the filter leaves it out, says so, and lands.

use super::flight::{FLIGHT, camera, fly, site_from_lander, truth_at_ns};
use nalgebra::{SVector, Vector2, Vector3};
use opnav::navigation::landing::{LandingConfig, LandingEpoch, LandingInput, LandingResult, navigate};
use opnav::stats::normalized_error_squared;
use rayon::prelude::*;
use std::ops::Range;

fn error(epoch: &LandingEpoch) -> SVector<f64, 9> {
    truth_at_ns(epoch.t_ns).error_of(&epoch.site_from_lander, &epoch.lander_velocity_in_site_m_s)
}

fn horizontal_m(epoch: &LandingEpoch) -> f64 {
    error(epoch).fixed_rows::<2>(0).norm()
}

fn nees(epoch: &LandingEpoch) -> f64 {
    normalized_error_squared(&error(epoch), &epoch.covariance).expect("a positive definite covariance") / 9.0
}

fn land(input: &LandingInput, config: &LandingConfig) -> LandingResult {
    navigate(input, config, &|_| ()).expect("a navigable descent")
}

/// What a tracker may follow instead of the point.
#[derive(Debug, Clone, Copy)]
enum Wrong {
    /// The pixel is off by as much in every image.
    Pixels,
    /// It is that of a rock 60 m away.
    Rock,
    /// It is off to a new side in every image.
    Anywhere,
}

/// The flight with the sights of the point wrong in some frames.
fn misled(mut input: LandingInput, wrong: Wrong, frames: &Range<usize>) -> LandingInput {
    let (camera, lander_from_camera) = camera();
    for (frame, t_ns) in input.frame_times_ns.iter().enumerate().filter(|(k, _)| frames.contains(k)) {
        let rock = (site_from_lander(&truth_at_ns(*t_ns)) * lander_from_camera)
            .inverse_transform_point(&Vector3::new(-48.0, 36.0, 0.0).into());
        let sight = input.observations.iter_mut().find(|o| o.t_ns == *t_ns && o.track_id == 0).expect("in view");
        match wrong {
            Wrong::Pixels => sight.pixel_px += Vector2::new(60.0, 45.0),
            Wrong::Rock => sight.pixel_px = camera.project(&rock.coords).expect("before the camera"),
            Wrong::Anywhere => {
                let angle = frame as f64 * 2.4;
                sight.pixel_px += Vector2::new(angle.cos(), angle.sin()) * 75.0;
            }
        }
    }
    input
}

const FLIGHTS: u64 = 8;

fn flights(change: impl Fn(LandingInput) -> LandingInput + Sync) -> Vec<LandingInput> {
    (0..FLIGHTS).into_par_iter().map(|run| change(fly(&FLIGHT, run))).collect()
}

fn landed(inputs: &[LandingInput], config: &LandingConfig) -> Vec<LandingResult> {
    inputs.par_iter().map(|input| land(input, config)).collect()
}

/// The epoch of the last image.
fn last(result: &LandingResult) -> &LandingEpoch {
    &result.epochs[FLIGHT.frames - 1]
}

fn left_out(result: &LandingResult, frames: &Range<usize>) -> usize {
    result.epochs[frames.clone()].iter().filter(|e| e.contradiction.point_is_wrong && !e.known_seen).count()
}

/// 10 and 20 of 60 sights of the point are wrong, in three ways, with one and three other landmarks. Every one of them
/// is left out and every one before and after is used; the flight is, to the last bit, one in which the point was out of
/// sight meanwhile, and so is its covariance.
#[test]
fn a_wrong_point_is_left_out() {
    for (config, frames) in [(1, 20..30), (1, 20..40), (3, 10..20), (3, 20..40)]
        .map(|(unknown_landmarks, frames)| (LandingConfig { unknown_landmarks, ..LandingConfig::default() }, frames))
    {
        let blind = landed(&flights(|input| without_point(input, &frames)), &config);
        for wrong in [Wrong::Pixels, Wrong::Rock, Wrong::Anywhere] {
            let inputs = flights(|input| misled(input, wrong, &frames));
            for (result, blind) in landed(&inputs, &config).iter().zip(&blind) {
                assert_eq!(left_out(result, &frames), frames.len(), "{wrong:?} {frames:?}");
                assert_eq!(result.stretches(|e| e.contradiction.point_is_wrong).len(), 1);
                assert!(result.epochs[frames.end].known_seen, "{wrong:?} {frames:?}");
                for (a, b) in result.epochs.iter().zip(&blind.epochs) {
                    assert_eq!((a.site_from_lander, a.covariance), (b.site_from_lander, b.covariance), "{wrong:?}");
                }
                assert!(
                    horizontal_m(last(result)) < 0.2 && error(last(result))[2].abs() < 3.0,
                    "{}",
                    error(last(result))
                );
                let worst = result.epochs[frames.clone()].iter().map(nees).fold(0.0, f64::max);
                assert!(worst < 4.0, "NEES/9 {worst} while the point is wrong: {wrong:?} {frames:?}");
            }
        }
    }
}

fn without_point(mut input: LandingInput, frames: &Range<usize>) -> LandingInput {
    let away: Vec<i64> = input.frame_times_ns[frames.clone()].to_vec();
    input.observations.retain(|o| o.track_id != 0 || !away.contains(&o.t_ns));
    input
}

/// Negative control: the same sights lead a flight off that has no cause to doubt them, since they are wrong from the
/// first image on.
#[test]
fn a_point_that_was_never_right_is_believed() {
    let config = LandingConfig { unknown_landmarks: 3, ..LandingConfig::default() };
    for result in landed(&flights(|input| misled(input, Wrong::Rock, &(0..FLIGHT.frames))), &config) {
        assert!((55.0..65.0).contains(&horizontal_m(last(&result))), "{}", error(last(&result)));
        assert!(result.stretches(|e| e.contradiction.point_is_wrong).is_empty());
    }
}

/// With an uncertain designated point, which then is a landmark of the state.
#[test]
fn a_wrong_point_of_uncertain_place_is_left_out() {
    let frames = 20..30;
    let config = LandingConfig {
        unknown_landmarks: 3,
        designated_sigma_px: 0.1,
        designated_drift_px: 0.03,
        ..LandingConfig::default()
    };
    for result in landed(&flights(|input| misled(input, Wrong::Rock, &frames)), &config) {
        assert_eq!(left_out(&result, &frames), frames.len());
        assert!(result.epochs[frames.end].known_seen);
        assert!(nees(last(&result)) < 4.0 && horizontal_m(last(&result)) < 20.0, "{}", error(last(&result)));
    }
}

/// The IMU feels a push that never was: 15 m/s in a second. The other landmarks say so, and the filter, not the point, is
/// doubted and comes back.
#[test]
fn a_filter_led_off_by_its_imu_recovers() {
    let config = LandingConfig { unknown_landmarks: 3, ..LandingConfig::default() };
    let pushed = |mut input: LandingInput| {
        let end_ns = input.frame_times_ns[25];
        for s in input.imu.iter_mut().filter(|s| (end_ns - 1_000_000_000..end_ns).contains(&s.t_ns)) {
            s.specific_force_in_lander_m_s2 += Vector3::new(12.0, 9.0, 0.0);
        }
        input
    };
    for result in landed(&flights(pushed), &config) {
        assert!(result.epochs.iter().any(|e| e.contradiction.filter_is_wrong()));
        assert!(last(&result).known_seen);
        assert!(result.stretches(|e| e.contradiction.point_is_wrong).is_empty());
        assert!(horizontal_m(last(&result)) < 1.0 && error(last(&result))[2].abs() < 10.0, "{}", error(last(&result)));
    }
}
