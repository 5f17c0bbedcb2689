//! From pixels to touchdown: irregular frames, tracks of limited length, relief, outliers, missing images, wrong input.

use super::descent::{exact_increment, pose_error, truth};
use super::flight::{FLIGHT, Flight, camera, fly, truth_at_ns};
use nalgebra::{DMatrix, SVector, Unit, Vector2, Vector3};
use opnav::dataset::read_timed_table;
use opnav::navigation::landing::{
    BearingObservation, CameraMount, DescentEstimate, DescentState, FilterKind, LandingConfig, LandingEpoch,
    LandingError, LandingInput, LandingResult, LookAhead, navigate, survives, viewpoint, write_covariance_csv,
    write_estimate_csv,
};
use opnav::navigation::landmark::Selector;
use opnav::stats::{ConsistencyBounds, normalized_error_squared};
use rayon::prelude::*;

fn error(epoch: &LandingEpoch) -> SVector<f64, 9> {
    pose_error(&truth_at_ns(epoch.t_ns), &epoch.site_from_lander, &epoch.lander_velocity_in_site_m_s)
}

fn nees(epoch: &LandingEpoch) -> f64 {
    normalized_error_squared(&error(epoch), &epoch.covariance).expect("a positive definite covariance") / 9.0
}

fn land(input: &LandingInput, config: &LandingConfig) -> LandingResult {
    navigate(input, config, &|_| ()).expect("a navigable descent")
}

/// The epoch of the last frame.
fn last_frame(input: &LandingInput, result: &LandingResult) -> LandingEpoch {
    result.epochs[input.frame_times_ns.len() - 1].clone()
}

/// A perfect start, exact pixels, a flat ground and a noise-free IMU leave no error: every model agrees with the truth.
#[test]
fn nothing_wrong_in_nothing_wrong_out() {
    let exact = Flight { sigma_px: 0.0, relief: 0.0, imu_noise: 0.0, start: 0.0, ..FLIGHT };
    let input = fly(&exact, 0);
    for filter in [FilterKind::Hybrid, FilterKind::Standard] {
        let config = LandingConfig { filter, unknown_landmarks: 2, ..LandingConfig::default() };
        let result = land(&input, &config);
        assert_eq!(result.gated, 0);
        assert!(result.used > 150);
        for epoch in &result.epochs {
            let e = error(epoch);
            assert!(e.fixed_rows::<3>(0).norm() < 1e-3, "{filter:?} position {e} at {} ns", epoch.t_ns);
            assert!(e.fixed_rows::<6>(3).norm() < 1e-4, "{filter:?} velocity, attitude {e} at {} ns", epoch.t_ns);
        }
    }
}

/// 60 frames at equal ratios of range, ground with ±25 m of relief, 0.2 px: the errors of 24 flights at the last image
/// and at touchdown.
#[test]
fn lands_from_pixels_over_relief() {
    let flights: Vec<_> = (0..24u64).into_par_iter().map(|run| fly(&FLIGHT, run)).collect();
    let config = LandingConfig::default();
    let results: Vec<_> = flights.par_iter().map(|input| land(input, &config)).collect();
    let gated: usize = results.iter().map(|r| r.gated).sum();
    assert!(gated < 5, "{gated} good bearings gated");
    let mut total = [0.0; 2];
    for (input, result) in flights.iter().zip(&results) {
        assert_eq!(result.epochs.last().expect("epochs").t_ns, 198_000_000_000);
        for (place, epoch) in
            [last_frame(input, result), result.epochs[result.epochs.len() - 1].clone()].iter().enumerate()
        {
            let e = error(epoch);
            assert!(e.fixed_rows::<2>(0).norm() < 0.2, "horizontal {e}");
            assert!(e[2].abs() < 3.0 && e.fixed_rows::<3>(3).norm() < 0.3, "vertical, velocity {e}");
            total[place] += nees(epoch) / flights.len() as f64;
        }
    }
    let bounds = ConsistencyBounds::of_mean(9, flights.len(), 0.999);
    assert!(total.iter().all(|nees| bounds.contains(*nees)), "NEES {total:?}, bounds {bounds:?}");
}

/// A feature at the edge towards which the ground streams leaves the picture before it has been seen three times more;
/// one ahead stays.
#[test]
fn features_about_to_leave_are_not_chosen() {
    let (camera, lander_from_camera) = camera();
    let mount = CameraMount { camera, lander_from_camera };
    let (before, now) = (truth(95.0), truth(100.0));
    let increment = exact_increment(&before, &now, 5.0);
    let state = DescentState {
        lander_in_site_m: now.position_m,
        lander_velocity_in_site_m_s: now.velocity_m_s,
        lander_from_site: now.lander_from_site,
        biases: None,
        landmarks: Vec::new(),
    };
    let estimate = DescentEstimate { state: state.clone(), covariance: DMatrix::identity(9, 9) };
    let view = viewpoint(&estimate, &increment, 1e-3, &LandingConfig::default());
    let in_picture = |direction_in_site: Vector3<f64>, images: usize| {
        let direction = Unit::new_normalize(now.lander_from_site * direction_in_site);
        let bearing = BearingObservation::from_sigma(1, direction, 1e-3);
        survives(&state, &bearing, &mount, &LookAhead { view: &view, increment: &increment, images, margin_px: 4.0 })
    };
    let ahead = view.course_in_site();
    for (tangent, stays) in [(0.5, true), (-0.2, true), (-0.7, false)] {
        let direction = ahead * tangent - Vector3::z();
        assert!(in_picture(direction, 0), "{tangent} is in the picture now");
        assert_eq!(in_picture(direction, 3), stays, "{tangent} after three more images");
    }
    assert!(!in_picture(Vector3::z(), 0));
}

#[test]
fn every_selector_lands() {
    let input = fly(&FLIGHT, 3);
    for selector in [
        Selector::DepthError,
        Selector::Svd,
        Selector::Gdop,
        Selector::Condition,
        Selector::Covariance,
        Selector::Random,
        Selector::None,
    ] {
        let result = land(&input, &LandingConfig { selector, ..LandingConfig::default() });
        let e = error(&last_frame(&input, &result));
        let limit_m = if selector == Selector::None { 30.0 } else { 3.0 };
        assert!(e.fixed_rows::<3>(0).norm() < limit_m, "{selector:?} {e}");
        let followed = result.epochs.iter().filter(|epoch| epoch.unknown_track.is_some()).count();
        assert_eq!(followed > 40, selector != Selector::None, "{selector:?} followed {followed}");
    }
}

/// One observation in eight, of the designated point too, is wrong by some 25 px: they are gated, the flight lands.
#[test]
fn wrong_tracks_are_gated() {
    let mut input = fly(&FLIGHT, 1);
    let (mut wrong, mut wrong_designated) = (0, 0);
    for (k, o) in input.observations.iter_mut().enumerate().skip(200) {
        // 389 is prime, so that neither one track nor one frame takes more than its share.
        if (k * 389 + k / 7) % 8 == 0 {
            o.pixel_px += Vector2::new(if k % 3 == 0 { 25.0 } else { -20.0 }, 15.0);
            wrong += 1;
            wrong_designated += usize::from(o.track_id == 0);
        }
    }
    assert!(wrong > 500 && wrong_designated > 3, "{wrong} {wrong_designated}");
    let result = land(&input, &LandingConfig { unknown_landmarks: 3, ..LandingConfig::default() });
    assert!(result.gated >= 10, "{} gated", result.gated);
    assert!(result.epochs.iter().any(|e| !e.known_seen && e.gated > 0));
    let e = error(&last_frame(&input, &result));
    assert!(e.fixed_rows::<2>(0).norm() < 0.3 && e[2].abs() < 5.0, "{e}");
}

/// Ten frames without anything: the filter coasts and says so, its covariance does not shrink, then it recovers.
#[test]
fn missing_images_are_coasted_over() {
    let mut input = fly(&FLIGHT, 2);
    let (from_ns, to_ns) = (input.frame_times_ns[19], input.frame_times_ns[30]);
    input.observations.retain(|o| o.t_ns <= from_ns || o.t_ns >= to_ns);
    let result = land(&input, &LandingConfig::default());
    assert_eq!(result.coasted[0], (from_ns, input.frame_times_ns[29]));
    assert_eq!(result.coasted.len(), 2, "{:?}", result.coasted);
    let attitude = |k: usize| result.epochs[k].covariance.fixed_view::<3, 3>(6, 6).into_owned();
    for k in 20..30 {
        assert!(!result.epochs[k].known_seen && result.epochs[k].innovation_dof == 0);
        let growth = (attitude(k) - attitude(k - 1)).symmetric_eigenvalues().min();
        assert!(growth >= 0.0, "frame {k}: {growth}");
    }
    let e = error(&last_frame(&input, &result));
    assert!(e.fixed_rows::<2>(0).norm() < 0.2 && e[2].abs() < 3.0, "{e}");
    assert!(nees(&last_frame(&input, &result)) < 3.0);
}

/// Two seconds and a half without IMU samples: their motion is held, the covariance grows by more than it ever does in
/// between, the result says when, and images restore the rest.
#[test]
fn a_silent_imu_is_bridged() {
    let mut input = fly(&FLIGHT, 2);
    let gap_ns = 80_000_000_000..82_500_000_000;
    input.imu.retain(|s| !gap_ns.contains(&s.t_ns));
    let result = land(&input, &LandingConfig::default());
    let bridged_s: f64 = result.imu_gaps.iter().map(|gap| gap.bridged_s).sum();
    assert!((bridged_s - 2.5).abs() < 0.03, "{bridged_s} s");
    assert!(result.imu_gaps.iter().all(|gap| gap.interval_ns.1 > gap_ns.start && gap.interval_ns.0 < gap_ns.end));
    assert!(result.gated < 5, "{} gated", result.gated);
    let last = last_frame(&input, &result);
    let e = error(&last);
    assert!(e.fixed_rows::<2>(0).norm() < 0.5 && e[2].abs() < 5.0 && nees(&last) < 3.0, "{e} {}", nees(&last));
    // Without images the same gap shows in full: the velocity's 1σ grows by 0.5 m/s² · 2.5 s, or by the root of the sum of
    // squares of the parts before and after a frame that falls into the gap.
    input.observations.clear();
    let alone = land(&input, &LandingConfig::default());
    let after = alone.epochs.iter().position(|e| e.t_ns >= gap_ns.end).expect("an epoch after the gap");
    let before = alone.epochs.iter().rposition(|e| e.t_ns <= gap_ns.start).expect("an epoch before the gap");
    let grown = alone.epochs[after].covariance[(5, 5)] - alone.epochs[before].covariance[(5, 5)];
    assert!((0.78..2.2).contains(&grown), "{grown} m²/s²");
}

/// Smallest growth of the covariance of position, velocity and attitude from one epoch to the next, by the attitude, which
/// the motion does not stretch.
fn least_attitude_growth(epochs: &[LandingEpoch]) -> f64 {
    let attitude = |e: &LandingEpoch| e.covariance.fixed_view::<3, 3>(6, 6).into_owned();
    let growth = |pair: &[LandingEpoch]| (attitude(&pair[1]) - attitude(&pair[0])).symmetric_eigenvalues().min();
    epochs.windows(2).map(growth).fold(f64::INFINITY, f64::min)
}

/// For three frames every track jumps to somewhere else: everything is gated, the flight coasts and says so, no covariance
/// shrinks, and it recovers when the tracks are right again. (Contradicted for longer, the filter gives itself less
/// credit, and in the end believes what it sees.)
#[test]
fn a_time_of_nothing_but_wrong_tracks_is_coasted_over() {
    let mut input = fly(&FLIGHT, 6);
    let (from_ns, to_ns) = (input.frame_times_ns[25], input.frame_times_ns[27]);
    for (k, o) in input.observations.iter_mut().enumerate().filter(|(_, o)| (from_ns..=to_ns).contains(&o.t_ns)) {
        let side = if k % 2 == 0 { 1.0 } else { -1.0 };
        o.pixel_px += Vector2::new(60.0 * side, 45.0);
    }
    let result = land(&input, &LandingConfig { unknown_landmarks: 3, ..LandingConfig::default() });
    let first = &result.epochs[25..28];
    assert!(first.iter().all(|e| e.innovation_dof == 0 && e.gated > 0), "{first:?}");
    assert!(result.coasted.iter().any(|c| c.0 < from_ns && c.1 >= input.frame_times_ns[27]), "{:?}", result.coasted);
    assert!(least_attitude_growth(&result.epochs[24..28]) >= 0.0);
    let last = last_frame(&input, &result);
    assert!(error(&last).fixed_rows::<2>(0).norm() < 1.0 && error(&last)[2].abs() < 10.0, "{}", error(&last));
}

/// The designated point is lost for twenty frames: unknown landmarks carry the flight, then it is found again.
#[test]
fn a_lost_designated_point_is_survived() {
    let mut input = fly(&FLIGHT, 7);
    let (from_ns, to_ns) = (input.frame_times_ns[20], input.frame_times_ns[40]);
    input.observations.retain(|o| o.track_id != 0 || o.t_ns < from_ns || o.t_ns > to_ns);
    let result = land(&input, &LandingConfig { unknown_landmarks: 3, ..LandingConfig::default() });
    assert!(result.epochs[20..=40].iter().all(|e| !e.known_seen && e.innovation_dof > 0));
    let last = last_frame(&input, &result);
    assert!(last.known_seen && nees(&last) < 3.0, "NEES {}", nees(&last));
    assert!(error(&last).fixed_rows::<2>(0).norm() < 0.5, "{}", error(&last));
    // Never seen at all, it leaves the position to what it was at the start, and the covariance says so.
    input.observations.retain(|o| o.track_id != 0);
    let without = last_frame(&input, &land(&input, &LandingConfig::default()));
    assert!(without.covariance[(0, 0)].sqrt() > 100.0 && nees(&without) < 3.0, "NEES {}", nees(&without));
}

/// Without any image the whole flight is one coast.
#[test]
fn no_image_at_all_is_one_coast() {
    let mut input = fly(&FLIGHT, 2);
    input.observations.clear();
    let result = land(&input, &LandingConfig::default());
    assert_eq!(result.coasted, vec![(0, 198_000_000_000)]);
    assert!(nees(result.epochs.last().expect("epochs")) < 3.0);
}

/// A filter that is far surer of its start than it should be is contradicted, and comes back.
#[test]
fn overconfident_start_recovers() {
    let mut input = fly(&FLIGHT, 5);
    input.initial.sigma_position_m = 5.0;
    input.initial.sigma_velocity_m_s = 0.1;
    input.initial.sigma_attitude_rad = 1e-3;
    let result = land(&input, &LandingConfig::default());
    assert!(result.epochs[0].gated > 0, "the contradiction has to show");
    let e = error(&last_frame(&input, &result));
    assert!(e.fixed_rows::<2>(0).norm() < 0.5 && e[2].abs() < 10.0, "{e}");
}

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

/// The estimate depends on nothing but its input, and a fresh random selector is reproduced by its seed.
#[test]
fn same_input_same_estimate() {
    let input = fly(&FLIGHT, 4);
    let config = LandingConfig { selector: Selector::Random, seed: 9, ..LandingConfig::default() };
    assert_eq!(land(&input, &config), land(&input, &config));
    let other = LandingConfig { seed: 10, ..config.clone() };
    assert_ne!(land(&input, &config), land(&input, &other));
}

#[test]
fn result_files_hold_every_epoch() {
    let input = fly(&Flight { frames: 20, ..FLIGHT }, 0);
    let result = land(&input, &LandingConfig::default());
    let folder = tempfile::tempdir().expect("a folder");
    let (estimate, covariance) = (folder.path().join("estimate.csv"), folder.path().join("covariance.csv"));
    write_estimate_csv(&estimate, &result).expect("written");
    write_covariance_csv(&covariance, &result).expect("written");
    let estimate = read_timed_table(&estimate, 22).expect("readable");
    let covariance = read_timed_table(&covariance, 45).expect("readable");
    assert_eq!(estimate.rows.len(), result.epochs.len());
    assert_eq!(estimate.columns[10], "sigma_x_m");
    assert_eq!(covariance.columns[9], "cov_y_y");
    for ((e, c), epoch) in estimate.rows.iter().zip(&covariance.rows).zip(&result.epochs) {
        assert_eq!((e.t_ns, c.t_ns), (epoch.t_ns, epoch.t_ns));
        assert_eq!(e.values[2], epoch.site_from_lander.translation.z);
        assert_eq!(e.values[11], epoch.covariance[(1, 1)].sqrt());
        assert_eq!(c.values[9], epoch.covariance[(1, 1)]);
        assert_eq!(c.values[44], epoch.covariance[(8, 8)]);
    }
}

#[test]
fn wrong_input_is_named() {
    let good = fly(&Flight { frames: 5, ..FLIGHT }, 0);
    let config = LandingConfig::default();
    let failure = |change: &dyn Fn(&mut LandingInput)| {
        let mut input = good.clone();
        change(&mut input);
        navigate(&input, &config, &|_| ()).expect_err("this must not pass")
    };
    assert!(matches!(failure(&|i| i.frame_times_ns.clear()), LandingError::Empty { .. }));
    assert!(matches!(failure(&|i| i.imu.clear()), LandingError::Empty { .. }));
    assert!(matches!(failure(&|i| drop(i.imu.drain(1000..9000))), LandingError::ImuGap { .. }));
    assert!(matches!(failure(&|i| i.imu.truncate(500)), LandingError::ImuGap { .. }));
    assert!(matches!(failure(&|i| i.imu.swap(4, 5)), LandingError::Order { .. }));
    assert!(matches!(failure(&|i| i.frame_times_ns[1] = 0), LandingError::Order { .. }));
    assert!(matches!(failure(&|i| i.observations.reverse()), LandingError::Order { .. }));
    assert!(matches!(failure(&|i| i.observations[0].sigma_px = 0.0), LandingError::Value { .. }));
    assert!(matches!(failure(&|i| i.observations[0].pixel_px.x = f64::NAN), LandingError::Value { .. }));
    assert!(matches!(failure(&|i| i.imu[7].rate_in_lander_rad_s.x = f64::NAN), LandingError::Value { .. }));
    assert!(matches!(failure(&|i| i.initial.t_ns = 1), LandingError::LateStart { .. }));
    assert!(matches!(failure(&|i| i.initial.sigma_position_m = -1.0), LandingError::Value { .. }));
    assert!(matches!(failure(&|i| i.camera.focal_px.x = 0.0), LandingError::Camera(_)));
    assert!(matches!(failure(&|i| i.frame_times_ns.truncate(4)), LandingError::NoFrame { .. }));
    let text = failure(&|i| i.initial.t_ns = 1).to_string();
    assert!(text.contains("start at a later frame"), "{text}");
}

#[test]
fn wrong_options_are_named() {
    let wrong = [
        LandingConfig { gate_confidence: 1.0, ..LandingConfig::default() },
        LandingConfig { sigma_floor_px: 0.0, ..LandingConfig::default() },
        LandingConfig { gravity_m_s2: f64::NAN, ..LandingConfig::default() },
        LandingConfig { reselect_after: 0, ..LandingConfig::default() },
    ];
    for config in wrong {
        assert!(matches!(config.validate(), Err(LandingError::Config { .. })), "{config:?}");
    }
    LandingConfig::default().validate().expect("the defaults are fine");
    let text = toml::to_string(&LandingConfig::default()).expect("plain data");
    assert!(text.contains("selector = \"depth-error\"") && text.contains("filter = \"hybrid\""), "{text}");
    assert_eq!(toml::from_str::<LandingConfig>(&text).expect("readable"), LandingConfig::default());
    assert!(toml::from_str::<LandingConfig>("selektor = \"svd\"").is_err());
}

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
