//! `--config` and `--set` as a user meets them: what counts more, what is refused, and results made again from their own
//! `settings.toml`.

use super::outcomes::files;
use super::{assert_names, error_of, image_folder, opnav, small_scenario};
use crate::vision::texture::picture;
use nalgebra::Vector2;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A folder of textured pictures that slide.
fn pictures() -> TempDir {
    let folder = TempDir::new().expect("a temporary folder");
    for k in 0..5u32 {
        let moved = move |p: Vector2<f64>| p + Vector2::new(3.0, -2.0) * f64::from(k);
        picture(256, 256, 1.0, k.into(), moved).save(folder.path().join(format!("a{k}.png"))).expect("written");
    }
    folder
}

fn written(folder: &Path, name: &str, text: &str) -> PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, text).expect("written");
    path
}

/// Every file of a result, times left out.
fn result(out: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut all = BTreeMap::new();
    files(out, out, &mut all);
    all
}

fn front_end(out: &Path) -> Value {
    let summary = std::fs::read_to_string(out.join("summary.json")).expect("a summary");
    serde_json::from_str::<Value>(&summary).expect("JSON")["options"]["front_end"].clone()
}

#[test]
fn an_option_counts_more_than_a_change_and_a_change_more_than_a_file() {
    let (folder, results) = (pictures(), TempDir::new().expect("a temporary folder"));
    let config = written(
        results.path(),
        "mine.toml",
        "[input]\nfov_deg = 60\n[front_end.matcher]\ndescriptor = \"sift\"\nguided_radius_px = 50\n[front_end.detector]\nmax_features = 150\n",
    );
    let found = |name: &str, more: &[&str]| {
        let out = results.path().join(name);
        let mut run = opnav();
        run.arg("track").arg(folder.path()).arg("--config").arg(&config).args(more).arg("--out").arg(&out);
        run.assert().success();
        let found = front_end(&out);
        let descriptor = found["matcher"]["descriptor"].as_str().expect("a word").to_string();
        (descriptor, found["detector"]["max_features"].clone(), found["matcher"]["guided_radius_px"].clone())
    };
    let change = ["--set", "front_end.detector.max_features=120", "--set", "front_end.matcher.descriptor=sift"];
    assert_eq!(found("file", &[]), ("sift".into(), 150.into(), 50.0.into()));
    assert_eq!(found("change", &change), ("sift".into(), 120.into(), 50.0.into()));
    let all = [&change[..], &["--descriptor", "orb"]].concat();
    assert_eq!(found("option", &all), ("orb".into(), 120.into(), 50.0.into()));
}

#[test]
fn what_no_setting_allows_is_refused_before_anything_is_written() {
    let (folder, results) = (image_folder(), TempDir::new().expect("a temporary folder"));
    let config = written(results.path(), "mine.toml", "[front_end.klt]\nlevel = 2\n");
    let out = results.path().join("out");
    let run = |command: &str, more: &[&str]| {
        let mut run = opnav();
        run.arg(command).arg(folder.path()).arg("--out").arg(&out).args(more);
        run
    };
    for command in ["track", "land", "tumble"] {
        let error = error_of(run(command, &[]).arg("--config").arg(&config));
        assert_names(&error, &["mine.toml, line 2", "front_end.klt.level", "did you mean front_end.klt.levels?"]);
        let error = error_of(&mut run(command, &["--set", "front_end.klt.levels=0"]));
        assert_names(&error, &["--set front_end.klt.levels=0", "front_end.klt.levels is 0", "1 or more"]);
        let error = error_of(&mut run(command, &["--set", "front_end.klt.levels=many"]));
        assert_names(&error, &["--set front_end.klt.levels=many", "front_end.klt.levels"]);
        run(command, &["--set", "levels"]).assert().code(2);
        run(command, &["--set", "=2"]).assert().code(2);
        assert!(!out.exists(), "a failed job left {}", out.display());
    }
    let error = error_of(opnav().args(["demo", "--set", "land.landing.seed=-1", "--out"]).arg(&out));
    assert_names(&error, &["--set land.landing.seed=-1", "land.landing.seed"]);
    let error = error_of(opnav().args(["montecarlo", "landing", "--set", "runs=2", "--out"]).arg(&out));
    assert_names(&error, &["there is no key runs", "did you mean campaign.runs?"]);
    assert!(!out.exists(), "a failed job left {}", out.display());
}

#[test]
fn every_command_with_settings_explains_them() {
    for command in [
        &["track"][..],
        &["land"],
        &["tumble"],
        &["map"],
        &["render"],
        &["demo"],
        &["bench", "render"],
        &["montecarlo", "landing"],
    ] {
        let output = opnav().args(command).arg("--help").assert().success().get_output().stdout.clone();
        assert_names(&String::from_utf8_lossy(&output), &["--config <FILE>", "--set <KEY=VALUE>", "opnav reference"]);
    }
}

/// Runs a command, then once more with nothing but the settings of its result, and compares.
fn made_again(command: &[&str], input: &Path, options: &[&str]) {
    let results = TempDir::new().expect("a temporary folder");
    let run = |name: &str| {
        let out = results.path().join(name);
        let mut run = opnav();
        run.args(command).arg("--out").arg(&out);
        if input.exists() {
            run.arg(input);
        }
        (run, out)
    };
    let (mut first, first_out) = run("first");
    first.args(options).assert().success();
    let settings = first_out.join("settings.toml");
    let (mut second, second_out) = run("second");
    second.arg("--config").arg(&settings).assert().success();
    let (first, second) = (result(&first_out), result(&second_out));
    assert!(
        first.contains_key("settings.toml") && first.keys().eq(second.keys()),
        "{:?} {:?}",
        first.keys(),
        second.keys()
    );
    for (name, bytes) in &first {
        assert!(second[name] == *bytes, "{name} differs");
    }
    let (mut plain, plain_out) = run("plain");
    let fov: Vec<&str> = options.iter().skip_while(|o| **o != "--fov-deg").take(2).copied().collect();
    plain.args(fov).assert().success();
    assert!(result(&plain_out) != first, "the options change nothing");
}

#[test]
fn tracking_is_made_again_from_its_settings() {
    let options = [
        "--fov-deg",
        "60",
        "--every",
        "2",
        "--frames",
        "0..4",
        "--rate-hz",
        "3",
        "--descriptor",
        "sift",
        "--set",
        "front_end.detector.max_features=150",
        "--set",
        "front_end.rotation.noise.correlated_error_share=0",
    ];
    made_again(&["track"], pictures().path(), &options);
}

#[test]
fn a_campaign_is_made_again_from_its_settings() {
    let options = [
        "--runs",
        "2",
        "--seed",
        "7",
        "--selector",
        "svd,none",
        "--path",
        "quintic",
        "--outliers",
        "0.05",
        "--relief",
        "20",
        "--sigma-bearing",
        "0.3",
        "--biases",
        "0.02,0.001",
        "--planet-rate-rad-s",
        "0,0,7.088e-5",
        "--filter",
        "standard",
        "--field-of-view",
        "wide",
        "--gravity",
        "3.7",
        "--set",
        "campaign.filter.ground.sigma_slope=0.07",
    ];
    let out = TempDir::new().expect("a temporary folder");
    let short = |more: &[&str]| {
        let mut run = opnav();
        run.args(["montecarlo", "landing"]).args(more).arg("--out").arg(out.path().join(more.len().to_string()));
        run.assert().success();
        result(&out.path().join(more.len().to_string()))
    };
    let first = short(&options);
    let settings = out.path().join(options.len().to_string()).join("settings.toml");
    let second = short(&["--config", settings.to_str().expect("a plain path")]);
    // The page tells how long each choice took.
    for (name, bytes) in first.iter().filter(|(name, _)| *name != "report.html") {
        assert!(second[name] == *bytes, "{name} differs");
    }
    let text = String::from_utf8_lossy(&first["settings.toml"]).to_string();
    assert_names(
        &text,
        &["outlier_share = 0.05", "gate_confidence = 0.99999", "selectors = [", "[campaign.filter.biases]"],
    );
}

#[test]
fn the_gate_that_goes_with_outliers_gives_way_to_a_stated_one() {
    let out = TempDir::new().expect("a temporary folder");
    let mut run = opnav();
    run.args([
        "montecarlo",
        "landing",
        "--runs",
        "1",
        "--outliers",
        "0.05",
        "--set",
        "campaign.filter.gate_confidence=0.9",
    ]);
    run.arg("--out").arg(out.path()).assert().success();
    let text = std::fs::read_to_string(out.path().join("settings.toml")).expect("settings");
    assert_names(&text, &["gate_confidence = 0.9\n", "outlier_share = 0.05"]);
}

#[test]
fn a_scenario_takes_a_file_of_settings_under_changes_and_options() {
    let folder = TempDir::new().expect("a temporary folder");
    let scenario = small_scenario(folder.path(), "");
    let config = written(
        folder.path(),
        "mine.toml",
        "seed = 6\n[camera]\nwidth_px = 64\nheight_px = 48\n[tumbling]\nframes = 1\ninertia = \"from-shape\"\n",
    );
    let out = folder.path().join("out");
    let mut run = opnav();
    run.arg("render").arg(&scenario).arg("--config").arg(&config).args([
        "--set",
        "camera.height_px=64",
        "--set",
        "seed=7",
    ]);
    run.args(["--seed", "8", "--out"]).arg(&out).assert().success();
    let resolved = std::fs::read_to_string(out.join("scenario.toml")).expect("the resolved scenario");
    assert_names(&resolved, &["seed = 8", "width_px = 64", "height_px = 64", "frames = 1", "inertia = \"from-shape\""]);
    let again = folder.path().join("again");
    opnav()
        .arg("render")
        .arg(&scenario)
        .arg("--config")
        .arg(out.join("scenario.toml"))
        .arg("--out")
        .arg(&again)
        .assert()
        .success();
    assert!(
        std::fs::read(out.join("manifest.json")).expect("read")
            == std::fs::read(again.join("manifest.json")).expect("read")
    );
    let wrong = written(folder.path(), "wrong.toml", "[camera]\n\nwidht_px = 64\n");
    let error = error_of(
        opnav().arg("render").arg(&scenario).arg("--config").arg(&wrong).arg("--out").arg(folder.path().join("no")),
    );
    assert_names(&error, &["wrong.toml, line 3", "camera.widht_px", "did you mean camera.width_px?"]);
}

#[test]
fn a_map_is_made_again_from_its_settings() {
    let folder = TempDir::new().expect("a temporary folder");
    let scenario = Path::new(env!("CARGO_MANIFEST_DIR")).join("datasets/mars_descent_small.toml");
    let map = |name: &str, more: &[&str]| {
        let out = folder.path().join(name);
        opnav().arg("map").arg(&scenario).args(more).arg("--out").arg(&out).assert().success();
        out
    };
    let first = map("first", &["--level", "4,100", "--level", "8,200", "--set", "descent.sun.elevation_deg=20"]);
    let settings = first.join("settings.toml");
    let text = std::fs::read_to_string(&settings).expect("settings");
    assert_names(&text, &["[[survey.levels]]", "metres_per_px = 4.0", "elevation_deg = 20.0"]);
    assert!(result(&first) == result(&map("second", &["--config", settings.to_str().expect("a plain path")])));
    let error = error_of(
        opnav()
            .arg("map")
            .arg(&scenario)
            .args(["--level", "8,200", "--level", "4,100", "--out"])
            .arg(folder.path().join("no")),
    );
    assert_names(&error, &["survey.levels is [8, 4] m a pixel", "from fine to coarse"]);
}
