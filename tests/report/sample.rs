//! A page with everything that a page can hold.

use image::{GrayImage, Luma};
use opnav::evaluation::{Metrics, Mission, Series, Verdict};
use opnav::report::*;
use opnav::stats::{ConsistencyBounds, random_stream};
use rand_distr::{ChiSquared, Distribution, StandardNormal};

/// Errors that fall from `start` to `end` over 198 s, inside their own sigma.
fn falling(name: &str, unit: &str, start: f64, end: f64) -> Series {
    let mut random = random_stream(5, name, 0);
    let mut wander = 0.0;
    let mut series = Series { name: name.into(), unit: unit.into(), ..Series::default() };
    for k in 0..=198 {
        let t = f64::from(k);
        let sigma = (end / start).powf((t / 150.0).min(1.0)) * start;
        let kick: f64 = StandardNormal.sample(&mut random);
        wander = 0.93 * wander + 0.37 * kick;
        series.t_s.push(t);
        series.sigma.push(sigma);
        series.values.push(sigma * wander);
    }
    series
}

fn nees(degrees: f64) -> Series {
    let mut random = random_stream(5, "nees", 0);
    let law = ChiSquared::new(degrees).expect("a law");
    let bound = Some(ConsistencyBounds::of_mean(degrees as usize, 1, 0.95));
    let values = (0..=198).map(|_| law.sample(&mut random) / degrees).collect();
    let t_s = (0..=198).map(f64::from).collect();
    Series { name: "nees_per_dof".into(), unit: "1".into(), t_s, values, sigma: vec![], bound }
}

fn add_front_end(metrics: &mut Metrics) {
    let mut random = random_stream(5, "pairs", 0);
    let t_s: Vec<f64> = (1..=198).map(f64::from).collect();
    let draw = |_: &f64| {
        let kick: f64 = StandardNormal.sample(&mut random);
        0.01 * (0.6 * kick).exp()
    };
    let values: Vec<f64> = t_s.iter().map(draw).collect();
    let sigma = vec![0.012; values.len()];
    metrics.add("pairs_ok", 197.0, "1");
    metrics.add("pairs_few_matches", 1.0, "1");
    metrics.add("pair_rotation_error_median", 0.0101, "deg");
    metrics.add("pair_rotation_error_p95", 0.0284, "deg");
    metrics.add_bounded("pair_nees_per_dof", 1.07, "1", Some(ConsistencyBounds::of_mean(3, 197, 0.95)));
    metrics.add("track_error_median", 0.118, "px");
    metrics.add("track_error_p95", 0.52, "px");
    metrics.series.push(Series {
        name: "pair_rotation_error".into(),
        unit: "deg".into(),
        t_s,
        values,
        sigma,
        bound: None,
    });
}

pub fn landing_metrics() -> Metrics {
    let mut metrics = Metrics::new(Mission::Landing);
    metrics.add("epochs", 199.0, "1");
    for prefix in ["last_picture_", "final_"] {
        metrics.add(&format!("{prefix}horizontal_error"), 0.1062, "m");
        metrics.add(&format!("{prefix}z_error"), -4.6931, "m");
        metrics.add(&format!("{prefix}speed_error"), 0.0801, "m/s");
        metrics.add(&format!("{prefix}roll_error"), 0.0241, "deg");
        metrics.add(&format!("{prefix}pitch_error"), -0.00012, "deg");
        metrics.add(&format!("{prefix}yaw_error"), 1.07, "deg");
    }
    metrics.add("final_from_tracked_point_horizontal_error", 0.0312, "m");
    metrics.add("final_from_tracked_point_z_error", -4.21, "m");
    metrics.add("tracked_point_from_site_origin", 0.0911, "m");
    metrics.add("ate_position_rms", 123.456, "m");
    metrics.add("rpe_10s_position_rms", 8.8715, "m");
    metrics.add_bounded("nees_per_dof_mean", 1.02, "1", Some(ConsistencyBounds::of_mean(9, 12, 0.95)));
    metrics.add("nees_effective_samples", 12.3, "1");
    for (axis, start) in [("x", 577.0), ("y", 577.0), ("z", 577.0)] {
        metrics.series.push(falling(
            &format!("position_error_{axis}"),
            "m",
            start,
            if axis == "z" { 1.5 } else { 0.03 },
        ));
    }
    for axis in ["x", "y", "z"] {
        metrics.series.push(falling(&format!("velocity_error_{axis}"), "m/s", 5.8, 0.02));
    }
    for (name, end) in [("roll_error", 0.006), ("pitch_error", 0.006), ("yaw_error", 1.08)] {
        metrics.series.push(falling(name, "deg", 1.15, end));
    }
    metrics.series.push(nees(9.0));
    let verdict = |name: &str, holds: bool, reason: &str| Verdict { name: name.into(), holds, reason: reason.into() };
    metrics.verdicts.push(verdict(
        "converged",
        true,
        "at 198.0 s against the site's origin: every error is under its limit",
    ));
    metrics.verdicts.push(verdict("consistent", false, "mean NEES/9 1.92 against [0.82, 1.19]: overconfident"));
    add_front_end(&mut metrics);
    metrics.note("ATE is the r.m.s. of the position error without alignment.");
    metrics
}

fn tumbling_metrics() -> Metrics {
    let mut metrics = Metrics::new(Mission::Tumbling);
    metrics.add("final_attitude_error", 0.031, "deg");
    metrics.add("rate_error_rms_last_fifth", 0.0018, "deg/s");
    for (name, truth, error) in [
        ("Lxx", 0.85, 1.7e-4),
        ("Lyy", 1.37, -2.6e-4),
        ("Lxy", 0.13, 8e-5),
        ("Lxz", 0.17, 2.4e-4),
        ("Lyz", -0.11, -1e-5),
    ] {
        metrics.add(&format!("true_{name}"), truth, "Lzz");
        metrics.add(&format!("{name}_error"), error, "Lzz");
        metrics.add(&format!("{name}_sigma"), 2e-4, "Lzz");
        metrics.series.push(falling(&format!("{name}_error"), "Lzz", 0.02, 2e-4));
    }
    for axis in ["x", "y", "z"] {
        metrics.series.push(falling(&format!("attitude_error_{axis}"), "deg", 0.05, 0.03));
        metrics.series.push(falling(&format!("rate_error_{axis}"), "deg/s", 0.3, 0.002));
    }
    metrics.series.push(nees(6.0));
    add_front_end(&mut metrics);
    metrics
}

/// Rolling ground with a few craters, well enough for a look.
fn frame(seed: f64) -> GrayImage {
    GrayImage::from_fn(480, 360, |x, y| {
        let (x, y) = (f64::from(x) / 40.0 + seed, f64::from(y) / 40.0);
        let waves = (1..6).map(|k| {
            let k = f64::from(k);
            (x * k + (y * k * 0.7 + seed).sin() * 1.7).sin() / k
        });
        Luma([(128.0 + 38.0 * waves.sum::<f64>()).clamp(0.0, 255.0) as u8])
    })
}

pub fn pictures() -> Vec<PageImage> {
    let picture = |t: u32| {
        let drawn = image::DynamicImage::ImageLuma8(frame(f64::from(t))).to_rgb8();
        let caption = format!("Frame at {t} s");
        PageImage { caption, png: image_png(&drawn, 640).expect("a PNG") }
    };
    vec![picture(0), picture(60), picture(120)]
}

pub fn sample_page() -> Page {
    let summary = serde_json::json!({ "timing_ms": { "load": 812.4, "track": 9210.0, "filter": 41.25 } });
    let (landing, tumbling) = (landing_metrics(), tumbling_metrics());
    let section = |heading: &str, done: &str, metrics: &Metrics| {
        let report = MissionReport {
            heading: heading.into(),
            done: done.into(),
            images: pictures(),
            metrics,
            summary: &summary,
        };
        mission_section(&report).expect("a section")
    };
    let environment = environment_table(&[
        ("opnav".into(), "0.1.0".into()),
        ("graphics adapter".into(), "llvmpipe (LLVM 15.0.6, 256 bits)".into()),
    ]);
    Page {
        title: "Optical navigation in deep space".into(),
        lead: "Two rendered missions, tracked and navigated from pictures, measured against exact truth.".into(),
        sections: vec![
            section(
                "Landing",
                "A descent of 198 s to the designated point, navigated by one camera & an inertial unit.",
                &landing,
            ),
            section("Tumbling body", "A small body turning freely, seen from a fixed camera for 198 s.", &tumbling),
            Section { heading: "Environment".into(), blocks: vec![environment] },
        ],
    }
}
