//! Landings: errors that are known are found exactly.

use super::bench::{
    LandingRow, SECOND_NS, assert_near, descent, figure, ground_under, image_times, landing_bench, landing_csv,
    perfect_landing, small_camera, true_camera,
};
use nalgebra::{UnitQuaternion, Vector2, Vector3};
use opnav::evaluation::*;
use std::fmt::Write;

#[test]
fn a_perfect_landing_has_no_error() {
    let bench = landing_bench();
    bench.put("estimate.csv", &landing_csv(&perfect_landing()));
    let metrics = bench.metrics();
    assert_eq!((metrics.mission, figure(&metrics, "epochs")), (Mission::Landing, 101.0));
    for name in
        ["final_horizontal_error", "final_z_error", "final_speed_error", "ate_position_rms", "rpe_10s_position_rms"]
    {
        assert_near(&metrics, name, 0.0, 1e-9);
    }
    for name in ["final_roll_error", "final_pitch_error", "final_yaw_error", "rpe_10s_attitude_rms"] {
        assert_near(&metrics, name, 0.0, 1e-6);
    }
    assert!(metrics.verdict("converged").expect("a verdict").holds);
    let x = metrics.series("position_error_x").expect("a curve");
    assert_eq!((x.t_s.len(), x.sigma[0], x.unit.as_str()), (101, 1.0, "m"));
    assert_eq!(metrics.series("roll_error").expect("a curve").sigma[0], 0.01f64.to_degrees());
    assert_eq!(metrics.series("velocity_error_z").expect("a curve").sigma[0], 6.0);
}

#[test]
fn a_known_offset_is_found_exactly() {
    let bench = landing_bench();
    let mut rows = perfect_landing();
    for row in &mut rows {
        row.pose.translation.vector -= Vector3::new(3.0, 4.0, -2.0);
        row.velocity -= Vector3::new(0.1, 0.2, -0.2);
        let (roll, pitch, yaw) = row.pose.rotation.euler_angles();
        row.pose.rotation = UnitQuaternion::from_euler_angles(roll - 0.001, pitch + 0.002, yaw - 3.0);
    }
    bench.put("estimate.csv", &landing_csv(&rows));
    let metrics = bench.metrics();
    assert_near(&metrics, "final_horizontal_error", 5.0, 1e-9);
    assert_near(&metrics, "final_z_error", -2.0, 1e-9);
    assert_near(&metrics, "final_speed_error", 0.3, 1e-9);
    assert_near(&metrics, "final_roll_error", 0.001f64.to_degrees(), 1e-9);
    assert_near(&metrics, "final_pitch_error", -0.002f64.to_degrees(), 1e-9);
    assert_near(&metrics, "final_yaw_error", 3f64.to_degrees(), 1e-9);
    assert_near(&metrics, "ate_position_rms", 29f64.sqrt(), 1e-9);
    assert!(metrics.series("position_error_y").expect("a curve").values.iter().all(|v| (v - 4.0).abs() < 1e-9));
    let verdict = metrics.verdict("converged").expect("a verdict");
    assert!(!verdict.holds);
    assert!(verdict.reason.contains("horizontal error 5.000 m") && verdict.reason.contains("pitch"), "{verdict:?}");
    assert!(!verdict.reason.contains("roll error") && !verdict.reason.contains("z error"), "{verdict:?}");
}

#[test]
fn relative_errors_see_drift_and_not_offset() {
    let bench = landing_bench();
    let mut rows = perfect_landing();
    for (k, row) in rows.iter_mut().enumerate() {
        row.pose.translation.vector += Vector3::new(100.0 + 0.5 * k as f64, 0.0, 0.0);
    }
    bench.put("estimate.csv", &landing_csv(&rows));
    assert_near(&bench.metrics(), "rpe_10s_position_rms", 5.0, 1e-9);
}

#[test]
fn a_swapped_frame_is_noticed() {
    let bench = landing_bench();
    let mut rows = perfect_landing();
    for row in &mut rows {
        row.pose.rotation = row.pose.rotation.inverse();
    }
    bench.put("estimate.csv", &landing_csv(&rows));
    let roll = &bench.metrics().series("roll_error").expect("a curve").values.clone();
    assert!(roll[0].abs() > 3.0, "an attitude given the wrong way round must show: {}", roll[0]);
}

#[test]
fn epochs_between_the_truth_samples_are_interpolated() {
    let bench = landing_bench();
    let rows: Vec<LandingRow> = (0..50)
        .map(|k| {
            let truth = descent(k * SECOND_NS + 51_234_567);
            LandingRow { t_ns: truth.t_ns, pose: truth.site_from_lander, velocity: truth.lander_velocity_in_site_m_s }
        })
        .collect();
    bench.put("estimate.csv", &landing_csv(&rows));
    let metrics = bench.metrics();
    assert_near(&metrics, "ate_position_rms", 0.0, 1e-9);
    assert_near(&metrics, "final_speed_error", 0.0, 1e-9);
    assert_near(&metrics, "final_roll_error", 0.0, 1e-4);
}

/// Track 0 with the given pixel in the last picture, 80 s.
fn tracks_csv(last: &Vector2<f64>) -> String {
    let mut text = String::from("t_ns,track_id,u_px,v_px,sigma_px,response\n");
    for t_ns in image_times() {
        let camera_from_site = true_camera(t_ns).inverse();
        let origin = camera_from_site.translation.vector;
        let pixel = small_camera().project(&origin).expect("ahead of the camera");
        let pixel = if t_ns == 80 * SECOND_NS { *last } else { pixel };
        writeln!(text, "{t_ns},0,{},{},0.1,0", pixel.x, pixel.y).expect("text");
    }
    text
}

#[test]
fn errors_are_told_from_the_ground_point_really_tracked() {
    let bench = landing_bench();
    let pixel = Vector2::new(40.3, 17.8);
    let (tracked, _) = ground_under(80 * SECOND_NS, &pixel);
    assert!(tracked.xy().norm() > 5.0, "the track must have slipped for this test: {tracked}");
    bench.put("tracks.csv", &tracks_csv(&pixel));
    // A perfect navigator that takes the tracked point for the origin.
    let mut rows = perfect_landing();
    for row in &mut rows {
        row.pose.translation.vector -= tracked;
    }
    bench.put("estimate.csv", &landing_csv(&rows));
    let metrics = bench.metrics();
    // Depth is stored in single precision and read between pixels: a few centimetres on this lens.
    assert_near(&metrics, "tracked_point_from_site_origin", tracked.norm(), 0.05);
    assert_near(&metrics, "tracked_point_drift", tracked.norm(), 0.5);
    assert_near(&metrics, "final_horizontal_error", tracked.xy().norm(), 1e-9);
    assert_near(&metrics, "final_from_tracked_point_horizontal_error", 0.0, 0.05);
    assert_near(&metrics, "last_picture_from_tracked_point_z_error", 0.0, 0.05);
    assert_near(&metrics, "last_picture_time", 80.0, 1e-9);
    assert!(!metrics.verdict("converged").expect("a verdict").holds);
    assert!(metrics.verdict("converged_from_tracked_point").expect("a verdict").holds);
}

#[test]
fn without_tracks_the_verdict_says_so() {
    let bench = landing_bench();
    bench.put("estimate.csv", &landing_csv(&perfect_landing()));
    let metrics = bench.metrics();
    assert!(metrics.verdict("converged_from_tracked_point").is_none());
    assert!(metrics.notes.iter().any(|n| n.contains("site's origin only")), "{:?}", metrics.notes);
}
