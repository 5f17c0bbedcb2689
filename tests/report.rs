//! Tests of the room `report`.

mod reference;

use image::{GrayImage, Luma};
use opnav::evaluation::{Metrics, Mission, Series, Verdict};
use opnav::report::*;
use opnav::stats::{ConsistencyBounds, random_stream};
use rand_distr::{ChiSquared, Distribution, StandardNormal};
use std::path::{Path, PathBuf};
use std::process::Command;

// ---------------------------------------------------------------------------------------------------- synthetic results

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

fn landing_metrics() -> Metrics {
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

fn pictures() -> Vec<Picture> {
    let picture = |t: u32| {
        let drawn = image::DynamicImage::ImageLuma8(frame(f64::from(t))).to_rgb8();
        let caption = format!("Frame at {t} s");
        Picture { caption, png: picture_png(&drawn, 640).expect("a PNG") }
    };
    vec![picture(0), picture(60), picture(120)]
}

fn sample_page() -> Page {
    let summary = serde_json::json!({ "timing_ms": { "load": 812.4, "track": 9210.0, "filter": 41.25 } });
    let (landing, tumbling) = (landing_metrics(), tumbling_metrics());
    let section = |heading: &str, done: &str, metrics: &Metrics| {
        let report = MissionReport {
            heading: heading.into(),
            done: done.into(),
            pictures: pictures(),
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

// ---------------------------------------------------------------------------------------------------- the page as text

#[test]
fn the_page_needs_nothing_from_outside() {
    let html = render_page(&sample_page());
    for outside in ["http://", "https://", "<script", "@import", "url(", "<iframe", "<link rel=\"stylesheet"] {
        let found = html.replace("http://www.w3.org/2000/svg", "").find(outside);
        assert_eq!(found, None, "{outside} in the page");
    }
    assert!(html.starts_with("<!DOCTYPE html><html lang=\"en\">"));
    assert!(html.len() < 4_000_000, "{} bytes", html.len());
}

#[test]
fn text_is_escaped() {
    let evil = "<img src=x onerror=alert(1)> & \"quotes\"".to_string();
    let table = Block::Table { caption: evil.clone(), header: vec![evil.clone()], rows: vec![vec![evil.clone()]] };
    let verdict = Verdict { name: evil.clone(), holds: true, reason: evil.clone() };
    let series = Series { t_s: vec![0.0, 1.0], values: vec![1.0, 2.0], ..Series::default() };
    let curve = Curve { label: evil.clone(), t_s: &series.t_s, values: &series.values, sigma: &[] };
    let plot = error_with_envelope(&evil, &evil, &[curve]).expect("a plot");
    let blocks = vec![
        Block::Heading(evil.clone()),
        Block::Paragraph(evil.clone()),
        Block::Notes(vec![evil.clone()]),
        Block::Verdicts(vec![verdict]),
        table,
        Block::Picture(Picture { caption: evil.clone(), png: vec![] }),
        Block::Plot(plot),
    ];
    let section = Section { heading: evil.clone(), blocks };
    let html = render_page(&Page { title: evil.clone(), lead: evil.clone(), sections: vec![section.clone(), section] });
    assert!(!html.contains("<img src=x"), "markup came through");
    assert!(html.matches("&lt;img src=x").count() > 20);
}

#[test]
fn every_plot_and_picture_says_what_it_shows() {
    let html = render_page(&sample_page());
    assert_eq!(html.matches("<svg").count(), html.matches("<svg role=\"img\"").count());
    assert_eq!(html.matches("<svg").count(), html.matches("<title>").count() - 1);
    assert_eq!(html.matches("<img").count(), html.matches("<img alt=\"Frame at").count());
    assert!(html.contains("<caption>Errors of the landing</caption>"));
    assert!(html.contains("scope=\"col\"") && html.contains("scope=\"row\""));
}

#[test]
fn tables_carry_units_and_readable_numbers() {
    let html = render_page(&sample_page());
    for text in ["−4.693", "0.1062", "1.20 × 10⁻⁴".replace("1.20", "−1.20").as_str(), "123.5", "°/s", "Filter", "41.25"]
    {
        assert!(html.contains(text), "{text}");
    }
}

#[test]
fn numbers_have_four_digits_that_matter() {
    for (value, text) in [
        (0.0, "0"),
        (1.0, "1"),
        (-12345.0, "−12345"),
        (123.456, "123.5"),
        (0.012_345_6, "0.01235"),
        (-0.000_123_4, "−1.23 × 10⁻⁴"),
        (4.56789e12, "4.57 × 10¹²"),
        (99_999.7, "100000"),
        (f64::NAN, "–"),
    ] {
        assert_eq!(format_number(value), text);
    }
    assert_eq!(label_of("pair_rotation_error_p95"), "Pair rotation error 95th percentile");
    assert_eq!(label_of("nees_per_dof_mean"), "NEES per degree of freedom, mean");
    assert_eq!(label_of("ate_position_rms"), "ATE, position r.m.s.");
    assert_eq!(unit_label("deg/s"), "°/s");
}

#[test]
fn plots_survive_whatever_they_are_given() {
    let curves = [
        (vec![], vec![], vec![]),
        (vec![1.0], vec![2.0], vec![3.0]),
        (vec![0.0, 1.0], vec![0.0, 0.0], vec![0.0, 0.0]),
        (vec![0.0, 1.0], vec![f64::NAN, f64::INFINITY], vec![f64::NAN, 1.0]),
        (vec![0.0, 1.0, 2.0], vec![1e-300, -1e300, 1.0], vec![]),
        ((0..50_000).map(f64::from).collect(), (0..50_000).map(|k| f64::from(k % 17) - 8.0).collect(), vec![]),
    ];
    let bounds = ConsistencyBounds::of_mean(9, 1, 0.95);
    for (t_s, values, sigma) in &curves {
        let curve = || Curve { label: "x".into(), t_s, values, sigma };
        let plots = [
            error_with_envelope("a", "m", &[curve(), curve()]),
            consistency_plot("b", &curve(), &bounds),
            magnitude_plot("c", "deg", &curve()),
        ];
        for plot in plots {
            let svg = plot.expect("a plot").svg;
            assert!(svg.trim_end().ends_with("</svg>") && !svg.contains("NaN"), "{} bytes", svg.len());
            assert!(svg.len() < 200_000, "{} bytes", svg.len());
        }
    }
}

/// Points of the error's polyline, in the drawing's units.
fn line_points(svg: &str) -> Vec<(f64, f64)> {
    let line = svg.lines().filter(|l| l.starts_with("<polyline") && l.contains("#1F4E79")).max_by_key(|l| l.len());
    let points = line.expect("an error line").split("points=\"").nth(1).expect("points");
    let pair = |p: &str| p.split_once(',').and_then(|(x, y)| Some((x.parse().ok()?, y.parse().ok()?)));
    points.split([' ', '"']).filter_map(pair).collect()
}

#[test]
fn a_peak_is_not_lost_in_a_long_series() {
    let n = 20_000;
    let t_s: Vec<f64> = (0..n).map(f64::from).collect();
    let values: Vec<f64> = (0..n).map(|k| if k == 12_345 { 9.0 } else { 1.0 }).collect();
    let curve = Curve { label: "x".into(), t_s: &t_s, values: &values, sigma: &[] };
    let points = line_points(&error_with_envelope("peak", "m", &[curve]).expect("a plot").svg);
    assert!(points.len() < 1000, "{}", points.len());
    let top = points.iter().min_by(|a, b| a.1.total_cmp(&b.1)).expect("points");
    let (left, right) = (points[0].0, points[points.len() - 1].0);
    assert!(((top.0 - left) / (right - left) - 12_345.0 / f64::from(n)).abs() < 2e-3, "{top:?}");
    assert_eq!(points.iter().filter(|p| p.1 == top.1).count(), 1);
}

#[test]
fn wide_pictures_are_shrunk_for_the_page() {
    let wide = image::RgbImage::from_pixel(64, 48, image::Rgb([100, 90, 80]));
    let small = image::load_from_memory(&picture_png(&wide, 32).expect("a PNG")).expect("it decodes");
    assert_eq!((small.width(), small.height()), (32, 24));
    let same = image::load_from_memory(&picture_png(&wide, 100).expect("a PNG")).expect("it decodes");
    assert_eq!((same.width(), same.height()), (64, 48));
}

#[test]
fn a_result_folder_becomes_a_section() {
    let dir = tempfile::tempdir().expect("a folder");
    let put = |name: &str, text: &str| std::fs::write(dir.path().join(name), text).expect("write");
    put("summary.json", "{\"mission\": \"landing\", \"timing_ms\": {\"filter\": 12.5}}");
    let error = result_section(dir.path(), vec![]).expect_err("not evaluated yet").to_string();
    assert!(error.contains("metrics.json is missing") && error.contains("opnav evaluate"), "{error}");
    landing_metrics().write(dir.path()).expect("write");
    let section = result_section(dir.path(), pictures()).expect("a section");
    assert_eq!(section.heading, "Landing");
    let plots = section.blocks.iter().filter(|b| matches!(b, Block::Plot(_))).count();
    let tables = section.blocks.iter().filter(|b| matches!(b, Block::Table { .. })).count();
    assert_eq!((plots, tables), (5, 4));
    let nowhere = dir.path().join("taken/page.html");
    put("taken", "a file where a folder should be");
    let error = write_report(&Page::default(), &nowhere).expect_err("no folder").to_string();
    assert!(error.contains("taken"), "{error}");
}

// ---------------------------------------------------------------------------------------------------- the page in a browser

fn browser() -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    let names = ["chromium", "chromium-browser", "google-chrome"];
    std::env::split_paths(&path).flat_map(|folder| names.map(|name| folder.join(name))).find(|file| file.is_file())
}

fn headless(browser: &Path, profile: &Path) -> Command {
    let mut command = Command::new(browser);
    command
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--hide-scrollbars"])
        .args(["--disable-background-networking", "--disable-component-update", "--disable-sync"])
        .arg(format!("--user-data-dir={}", profile.display()));
    command
}

/// What a browser made of a page.
#[derive(Debug, PartialEq)]
struct Seen {
    images: usize,
    broken_images: usize,
    empty_svgs: usize,
    svgs: usize,
    rows: usize,
    wider_than_the_window: bool,
}

const PROBE: &str = "<script>window.addEventListener('load', () => {
  const images = [...document.images], svgs = [...document.querySelectorAll('svg')];
  const seen = [images.length, images.filter(i => i.naturalWidth === 0).length,
    svgs.filter(s => s.getBoundingClientRect().height < 50 || s.querySelectorAll('text').length < 4).length,
    svgs.length, document.querySelectorAll('tbody tr').length,
    document.documentElement.scrollWidth > window.innerWidth ? 1 : 0];
  document.body.setAttribute('data-seen', seen.join(' '));
});</script>";

/// Opens a copy of the page, with a script that counts, and reads the counts from the resulting document.
fn look(browser: &Path, html: &str) -> Seen {
    let dir = tempfile::tempdir().expect("a folder");
    let file = dir.path().join("page.html");
    std::fs::write(&file, format!("{html}{PROBE}")).expect("write");
    let mut command = headless(browser, &dir.path().join("profile"));
    let output = command.arg("--dump-dom").arg(format!("file://{}", file.display())).output().expect("a browser");
    let dom = String::from_utf8_lossy(&output.stdout).into_owned();
    let seen = dom.split("data-seen=\"").nth(1).and_then(|rest| rest.split('"').next());
    let seen = seen.unwrap_or_else(|| panic!("no counts: {}", String::from_utf8_lossy(&output.stderr)));
    let n: Vec<usize> = seen.split(' ').map(|v| v.parse().expect("a count")).collect();
    Seen {
        images: n[0],
        broken_images: n[1],
        empty_svgs: n[2],
        svgs: n[3],
        rows: n[4],
        wider_than_the_window: n[5] == 1,
    }
}

#[test]
fn a_browser_shows_every_picture_plot_and_row() {
    let Some(browser) = browser() else {
        eprintln!(
            "\n*** SKIPPED: no chromium, chromium-browser or google-chrome on PATH; the page was not opened ***\n"
        );
        return;
    };
    let page = sample_page();
    let html = render_page(&page);
    let seen = look(&browser, &html);
    let rows = |block: &Block| if let Block::Table { rows, .. } = block { rows.len() } else { 0 };
    let rows: usize = page.sections.iter().flat_map(|s| &s.blocks).map(rows).sum();
    let good = Seen { images: 6, broken_images: 0, empty_svgs: 0, svgs: 10, rows, wider_than_the_window: false };
    assert_eq!(seen, good);
    // The other way round: a picture that is none, and a plot without content, have to be noticed.
    let mut broken = page;
    let png = vec![0x89, b'P', b'N', b'G', 1, 2, 3];
    broken.sections[2].blocks.push(Block::Picture(Picture { caption: "broken".into(), png }));
    let svg = "<svg viewBox=\"0 0 100 1\"></svg>".into();
    broken.sections[2].blocks.push(Block::Plot(Plot { title: "empty".into(), svg, legend: vec![] }));
    assert_eq!(
        look(&browser, &render_page(&broken)),
        Seen { images: 7, broken_images: 1, empty_svgs: 1, svgs: 11, ..good }
    );
}

/// Makes the page and its screenshots for a person to look at: `OPNAV_LOOK=folder cargo test look_at_the_page`.
#[test]
fn look_at_the_page() {
    let Some(folder) = std::env::var_os("OPNAV_LOOK").map(PathBuf::from) else { return };
    let file = folder.join("page.html");
    write_report(&sample_page(), &file).expect("write");
    let Some(browser) = browser() else { return };
    for (name, size) in [("wide.png", "1200,7600"), ("narrow.png", "420,9000")] {
        let shot = format!("--screenshot={}", folder.join(name).display());
        let profile = tempfile::tempdir().expect("a folder");
        let mut command = headless(&browser, profile.path());
        command.arg(shot).arg(format!("--window-size={size}")).arg(format!("file://{}", file.display()));
        assert!(command.output().expect("a browser").status.success());
    }
}
