//! The front end over rendered sequences, from pixels to rotations and to the designated point, against its bounds.

use crate::accuracy_bar::{Bar, check_table};
use crate::vision::accuracy::known_center::with_known_center;
use opnav::evaluation::Metrics;
use opnav::pipeline::{
    FrontEndConfig, FrontEndMode, InputSettings, LandRequest, LandSettings, Silent, SynthesizeRequest, TrackRequest,
    TrackSettings, evaluate_result, land, synthesize, track,
};
use opnav::settings::Layers;
use std::ops::Range;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// First frames of the parts of the reference descent that are judged: from 6.6 km, 4.5 km, 2.4 km, 0.8 km and 100 m.
const DESCENT_FRAMES: [usize; 5] = [0, 30, 70, 125, 170];
const FRAMES_A_PART: usize = 12;
/// Terrains over which the consistency at each height is averaged: the pairs of one part share pictures and ground, and
/// their mean NEES alone scatters by a third. The covariance was fitted to the first one and others, not to the last four.
const TERRAINS: [u64; 5] = [1, 8, 9, 10, 11];
const BODIES: [&str; 4] = ["tumbling_paper", "itokawa", "bennu", "tumbling_near_spin"];
const BODY_FRAMES: usize = 16;

fn render(scenario: &str, seed: Option<u64>, frames: Option<Range<usize>>, folder: &Path) -> PathBuf {
    let out = folder.join("images");
    let request = SynthesizeRequest {
        scenario: Path::new(env!("CARGO_MANIFEST_DIR")).join("datasets").join(scenario).with_extension("toml"),
        out: out.clone(),
        layers: Layers { file: None, overrides: seed.iter().map(|seed| format!("seed={seed}")).collect() },
        frames,
        resume: false,
        adapter: None,
    };
    synthesize(&request, &Silent).expect("the scenario renders");
    out
}

/// Tracks into a folder beside the pictures, one a mode and part.
fn tracked(images: &Path, frames: Option<Range<usize>>, mode: FrontEndMode) -> (Metrics, PathBuf) {
    let part = frames.as_ref().map_or(0, |f| f.start);
    let request = TrackRequest {
        folder: images.into(),
        out: images.with_file_name(format!("tracks_{part}")),
        settings: TrackSettings {
            input: InputSettings { frames: frames.map(|f| [f.start, f.end]), ..InputSettings::default() },
            front_end: FrontEndConfig { mode, ..FrontEndConfig::default() },
        },
    };
    track(&request, &Silent).expect("the sequence is tracked");
    (evaluate_result(&request.out, images).expect("the result is evaluated"), request.out)
}

fn figure(metrics: &Metrics, name: &str) -> f64 {
    metrics.figure(name).unwrap_or(f64::NAN)
}

fn error_bars(what: &str, metrics: &Metrics) -> Vec<Bar> {
    let bar = |name: &str| format!("{what}: {name}");
    vec![
        Bar::at_most(bar("rotation a pair, median"), figure(metrics, "pair_rotation_error_median"), 0.05, "deg"),
        Bar::at_most(bar("rotation a pair, 95 %"), figure(metrics, "pair_rotation_error_p95"), 0.2, "deg"),
        Bar::stated(bar("pairs"), figure(metrics, "pairs_ok"), ""),
    ]
}

fn consistency_bars(what: &str, nees: f64) -> [Bar; 2] {
    let name = format!("{what}: NEES per degree of freedom");
    [Bar::at_least(name.clone(), nees, 0.7, ""), Bar::at_most(name, nees, 1.5, "")]
}

/// Mean NEES per degree of freedom of a part of the descent over the terrains, that of the first one given.
fn mean_nees(first: usize, of_first_terrain: f64) -> f64 {
    let of_other = TERRAINS[1..].iter().map(|seed| {
        let folder = TempDir::new().expect("a temporary folder");
        let images = render("mars_descent", Some(*seed), Some(first..first + FRAMES_A_PART), folder.path());
        figure(&tracked(&images, None, FrontEndMode::Auto).0, "pair_nees_per_dof")
    });
    (of_first_terrain + of_other.sum::<f64>()) / TERRAINS.len() as f64
}

fn descent() -> Vec<Bar> {
    let folder = TempDir::new().expect("a temporary folder");
    let images = render("mars_descent", Some(TERRAINS[0]), None, folder.path());
    let mut bars = Vec::new();
    for first in DESCENT_FRAMES {
        let what = format!("reference descent from frame {first}");
        let (metrics, _) = tracked(&images, Some(first..first + FRAMES_A_PART), FrontEndMode::Auto);
        bars.extend(error_bars(&what, &metrics));
        let nees = figure(&metrics, "pair_nees_per_dof");
        bars.extend(consistency_bars(&format!("{what}, terrain 1 alone"), nees));
        bars.extend(consistency_bars(&format!("{what}, five terrains"), mean_nees(first, nees)));
    }
    let request =
        LandRequest { folder: images.clone(), out: folder.path().join("landing"), settings: LandSettings::default() };
    land(&request, &Silent).expect("the descent is navigated");
    let metrics = evaluate_result(&request.out, &images).expect("the result is evaluated");
    let far_px = figure(&metrics, "tracked_point_pixel_error_beyond_3km_max");
    bars.push(Bar::at_most("designated point beyond 3 km, worst", far_px, 0.5, "px"));
    let drift_m = figure(&metrics, "tracked_point_drift");
    bars.push(Bar::at_most("designated point, drift over the ground down to 15 m", drift_m, 2.0, "m"));
    bars
}

fn body(scenario: &str) -> Vec<Bar> {
    let folder = TempDir::new().expect("a temporary folder");
    let images = render(scenario, None, Some(0..BODY_FRAMES), folder.path());
    let (metrics, tracks) = tracked(&images, None, FrontEndMode::FixedCenter);
    let mut bars = error_bars(scenario, &metrics);
    bars.extend(consistency_bars(scenario, figure(&metrics, "pair_nees_per_dof")));
    let known = with_known_center(&images, &tracks);
    bars.push(Bar::stated(format!("{scenario}: median, the centre known"), known.error_deg, "deg"));
    bars.push(Bar::stated(format!("{scenario}: median that its bound predicts"), known.predicted_deg, "deg"));
    let exact_deg = known.error_of_true_pixels_deg;
    bars.push(Bar::at_most(format!("{scenario}: median by true pixels, the centre known"), exact_deg, 1e-3, "deg"));
    let floor_deg = known.error_of_white_noise_deg;
    bars.push(Bar::stated(format!("{scenario}: median by true pixels and white noise"), floor_deg, "deg"));
    bars
}

#[test]
#[ignore = "minutes long: run by `make accuracy`"]
fn accuracy_of_the_rendered_descent() {
    check_table("rendered descent", std::iter::once_with(descent));
}

#[test]
#[ignore = "minutes long: run by `make accuracy`"]
fn accuracy_of_rendered_bodies() {
    check_table("rendered bodies", BODIES.iter().map(|scenario| body(scenario)));
}
