//! When pictures are taken.

use super::{STEP_NS, path};
use opnav::scene::FrameSchedule;

#[test]
fn constant_scale_images_shrink_the_height_by_one_ratio() {
    let schedule = FrameSchedule::ConstantScale { count: 60, end_height_m: 15.0 };
    let times_ns = schedule.times_ns(&path(), STEP_NS).unwrap();
    assert_eq!((times_ns.len(), times_ns[0]), (60, 0));
    assert!(times_ns.iter().all(|t| t % STEP_NS == 0));
    let heights: Vec<f64> = times_ns.iter().map(|t| path().position_in_site_m(*t as f64 * 1e-9).z).collect();
    let ratio = (15.0_f64 / 6570.0).powf(1.0 / 59.0);
    for pair in heights.windows(2) {
        assert!((pair[1] / pair[0] / ratio - 1.0).abs() < 5e-3, "{pair:?}"); // time is rounded to 10 ms
    }
    assert!((heights[59] - 15.0).abs() < 0.05, "{}", heights[59]);
    let crowded = FrameSchedule::ConstantScale { count: 50_000, end_height_m: 15.0 };
    let error = crowded.times_ns(&path(), STEP_NS).unwrap_err().to_string();
    assert!(error.contains("constant-scale.count"), "{error}");
}

#[test]
fn uniform_images_end_at_the_height_or_the_time() {
    let times = |rate_hz, start_s, end_s| {
        FrameSchedule::Uniform { rate_hz, start_s, end_s, end_height_m: 15.0 }.times_ns(&path(), STEP_NS).unwrap()
    };
    let all = times(1.0, 0.0, 1e4);
    assert!(all.iter().enumerate().all(|(index, t)| *t == index as i64 * 1_000_000_000));
    let height_m = |t_ns: i64| path().position_in_site_m(t_ns as f64 * 1e-9).z;
    let last = *all.last().unwrap();
    assert!(height_m(last) >= 15.0 && height_m(last + 1_000_000_000) < 15.0);
    assert_eq!(times(2.0, 10.0, 12.0), [10.0, 10.5, 11.0, 11.5, 12.0].map(|t| (t * 1e9) as i64));
    assert_eq!(times(30.0, 0.0, 0.1), [0, 30_000_000, 70_000_000, 100_000_000]);
    let none = FrameSchedule::Uniform { rate_hz: 1.0, start_s: 197.9, end_s: 1e4, end_height_m: 15.0 };
    assert!(none.times_ns(&path(), STEP_NS).unwrap_err().to_string().contains("start_s"));
}
