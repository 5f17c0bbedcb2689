//! Landings from pixels: the reference descent rendered over ten terrains with ten initial errors, navigated from its
//! pictures alone and with a map, against the bars.
//!
//! `OPNAV_DESCENTS=DIR` keeps the rendered descents in a folder (about 1 GB each) and takes them from there the next time;
//! `OPNAV_DESCENT_COUNT` flies fewer than ten.

use crate::accuracy_bar::{Bar, check_table};
use opnav::evaluation::Metrics;
use opnav::pipeline::{
    LandInput, LandRequest, LandSettings, MapRequest, Silent, SynthesizeRequest, evaluate_result, land, make_map,
    synthesize,
};
use opnav::settings::Layers;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// Descents that are kept, or a folder that goes with the test.
enum Store {
    Kept(PathBuf),
    Passing(TempDir),
}

impl Store {
    fn new() -> Self {
        match std::env::var_os("OPNAV_DESCENTS") {
            Some(folder) => Store::Kept(folder.into()),
            None => Store::Passing(TempDir::new().expect("a temporary folder")),
        }
    }

    fn path(&self) -> &Path {
        match self {
            Store::Kept(path) => path,
            Store::Passing(folder) => folder.path(),
        }
    }
}

fn scenario() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("datasets/mars_descent.toml")
}

fn descent(seed: u64, store: &Store) -> PathBuf {
    let out = store.path().join(format!("s{seed}"));
    if !out.join("manifest.json").is_file() {
        let request = SynthesizeRequest {
            scenario: scenario(),
            out: out.clone(),
            layers: Layers::from(&[format!("seed={seed}")][..]),
            frames: None,
            resume: out.exists(),
            adapter: None,
        };
        synthesize(&request, &Silent).expect("the scenario renders");
    }
    out
}

fn navigated(images: &Path, map: Option<PathBuf>) -> Metrics {
    let folder = TempDir::new().expect("a temporary folder");
    let request = LandRequest {
        folder: images.into(),
        out: folder.path().join("landing"),
        settings: LandSettings { input: LandInput { map }, ..LandSettings::default() },
    };
    land(&request, &Silent).expect("the descent is navigated");
    evaluate_result(&request.out, images).expect("the result is evaluated")
}

/// 3 r.m.s. of a figure over the descents; an axis where `axes` of them are in it.
fn three_rms(all: &[Metrics], name: &str, axes: f64) -> f64 {
    let square = |m: &Metrics| m.figure(name).unwrap_or(f64::NAN).powi(2) / axes;
    3.0 * (all.iter().map(square).sum::<f64>() / all.len() as f64).sqrt()
}

fn count(all: &[Metrics], verdict: &str) -> f64 {
    all.iter().filter(|m| m.verdict(verdict).is_some_and(|v| v.holds)).count() as f64
}

fn common_bars(what: &str, all: &[Metrics], from: &str) -> Vec<Bar> {
    let mut bars = Vec::new();
    for (when, place) in [("last picture", "last_picture"), ("198 s", "final")] {
        let name = |quantity: &str| format!("{what}, {when}: {quantity}, 3 r.m.s.");
        let figure = |quantity: &str| three_rms(all, &format!("{place}_{quantity}"), 1.0);
        let horizontal = three_rms(all, &format!("{place}_{from}horizontal_error"), 2.0);
        bars.push(Bar::at_most(name("horizontal an axis"), horizontal, 0.5, "m"));
        bars.push(Bar::at_most(name("speed"), figure("speed_error"), 0.15, "m/s"));
        bars.push(Bar::at_most(name("roll"), figure("roll_error"), 0.05, "°"));
        bars.push(Bar::at_most(name("pitch"), figure("pitch_error"), 0.05, "°"));
    }
    let mean = all.iter().filter_map(|m| m.figure("nees_per_dof_mean")).sum::<f64>() / all.len() as f64;
    bars.push(Bar::at_least(format!("{what}: NEES/9, mean over the descents"), mean, 0.6, ""));
    bars.push(Bar::at_most(format!("{what}: NEES/9, mean over the descents"), mean, 1.6, ""));
    bars
}

fn without_map(all: &[Metrics]) -> Vec<Bar> {
    let flown = all.len() as f64;
    let mut bars = vec![Bar::at_least(
        "pixels: converged above the tracked point",
        count(all, "converged_from_tracked_point"),
        flown,
        "",
    )];
    bars.extend(common_bars("pixels", all, "from_tracked_point_"));
    for (when, place) in [("last picture", "last_picture"), ("198 s", "final")] {
        let origin = three_rms(all, &format!("{place}_horizontal_error"), 2.0);
        bars.push(Bar::at_most(format!("pixels, {when}: from the site's origin, 3 r.m.s. an axis"), origin, 3.0, "m"));
        let z = three_rms(all, &format!("{place}_from_tracked_point_z_error"), 1.0);
        bars.push(Bar::at_most(format!("pixels, {when}: z, 3 r.m.s."), z, 6.0, "m"));
    }
    bars.push(Bar::stated(
        "pixels: drift of the tracked point, 3 r.m.s.",
        three_rms(all, "tracked_point_drift", 1.0),
        "m",
    ));
    bars
}

fn with_map(all: &[Metrics]) -> Vec<Bar> {
    let mut bars = vec![Bar::at_least("map: converged", count(all, "converged"), all.len() as f64, "")];
    bars.extend(common_bars("map", all, ""));
    for (when, place) in [("last picture", "last_picture"), ("198 s", "final")] {
        let figure = |quantity: &str| three_rms(all, &format!("{place}_{quantity}"), 1.0);
        bars.push(Bar::at_most(format!("map, {when}: z, 3 r.m.s."), figure("z_error"), 1.0, "m"));
        bars.push(Bar::at_most(format!("map, {when}: yaw, 3 r.m.s."), figure("yaw_error"), 0.05, "°"));
    }
    bars
}

#[test]
#[ignore = "renders ten whole descents: run by `make accuracy`"]
fn accuracy_of_rendered_landings() {
    let store = Store::new();
    let count = std::env::var("OPNAV_DESCENT_COUNT").ok().and_then(|n| n.parse().ok()).unwrap_or(10);
    let (mut alone, mut mapped) = (Vec::new(), Vec::new());
    for seed in 1..=count {
        let images = descent(seed, &store);
        let map = store.path().join(format!("map{seed}"));
        if !map.is_dir() {
            let layers = Layers::from(&[format!("seed={seed}")][..]);
            let levels = Vec::new();
            let request = MapRequest { scenario: scenario(), out: map.clone(), layers, levels, adapter: None };
            make_map(&request, &Silent).expect("the map is drawn");
        }
        alone.push(navigated(&images, None));
        mapped.push(navigated(&images, Some(map)));
        println!("descent {seed} flown");
        if matches!(store, Store::Passing(_)) {
            std::fs::remove_dir_all(&images).expect("the pictures are removed");
        }
    }
    check_table("Landing from pixels", [without_map(&alone), with_map(&mapped)].into_iter());
}
