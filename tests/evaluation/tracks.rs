//! Tracks against the surface points that they follow.

use super::bench::{Bench, assert_near, figure, ground_under, image_times, landing_bench, small_camera, true_camera};
use nalgebra::Vector2;
use std::fmt::Write;
use std::fs;

/// Five pictures of a descent with tracks on a grid of ground points; every second picture is off by `shift_px`.
fn track_bench(shift_px: f64) -> Bench {
    let bench = landing_bench();
    bench.put("summary.json", "{\"mission\": \"tracking\"}");
    let mut text = String::from("t_ns,track_id,u_px,v_px,sigma_px,response\n");
    for (frame, t_ns) in image_times().enumerate() {
        let camera_from_site = true_camera(t_ns).inverse();
        for id in 0..25 {
            let start = Vector2::new(20.0 + 5.5 * f64::from(id % 5), 14.0 + 4.7 * f64::from(id / 5));
            let point = ground_under(0, &start).0 * 0.1;
            let seen = camera_from_site * nalgebra::Point3::from(point);
            let pixel = small_camera().project(&seen.coords).expect("ahead");
            if small_camera().contains(&pixel, 2.0) {
                let shift = if frame % 2 == 1 { shift_px } else { 0.0 };
                writeln!(text, "{t_ns},{},{},{},0.1,1", id + 1, pixel.x + shift, pixel.y).expect("text");
            }
        }
    }
    bench.put("tracks.csv", &text);
    bench
}

#[test]
fn tracks_on_their_surface_points_have_no_error_and_slips_are_measured() {
    let metrics = track_bench(0.0).metrics();
    assert!(figure(&metrics, "track_steps_judged") > 60.0);
    assert_near(&metrics, "track_error_p95", 0.0, 0.02);
    let metrics = track_bench(3.0).metrics();
    // A shift of 3 px in one picture only shows in full from or into it, but for the change of scale between the two.
    let median = figure(&metrics, "track_error_median");
    assert!((2.5..6.0).contains(&median), "{median}");
}

#[test]
fn swapped_tracks_are_noticed() {
    let bench = track_bench(0.0);
    let text = fs::read_to_string(bench.result().join("tracks.csv")).expect("written");
    let (mut swapped, mut lines) = (String::new(), text.lines());
    writeln!(swapped, "{}", lines.next().expect("a header")).expect("text");
    for line in lines {
        let mut fields: Vec<&str> = line.split(',').collect();
        if fields[0] == "20000000000" {
            fields.swap(2, 3);
        }
        writeln!(swapped, "{}", fields.join(",")).expect("text");
    }
    bench.put("tracks.csv", &swapped);
    assert!(figure(&bench.metrics(), "track_error_p95") > 5.0);
}
