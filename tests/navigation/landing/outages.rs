//! Times without images, without an IMU or without right tracks are coasted over.

use super::flight::{FLIGHT, fly};
use super::flown::{error, land, last_frame, nees};
use nalgebra::Vector2;
use opnav::navigation::landing::{LandingConfig, LandingEpoch};

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
