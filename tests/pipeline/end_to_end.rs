//! From pixels to the state, both missions, through the command line's own stories; and the truth wall.

use opnav::evaluation::Metrics;
use opnav::pipeline::{
    LandRequest, LandSettings, Silent, SynthesizeRequest, TumbleRequest, TumbleSettings, evaluate_result, land,
    synthesize, tumble, write_page,
};
use opnav::settings::Layers;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

pub fn dataset(scenario: &str, seed: u64, folder: &Path) -> PathBuf {
    let out = folder.join("images");
    let request = SynthesizeRequest {
        scenario: Path::new(env!("CARGO_MANIFEST_DIR")).join("datasets").join(scenario),
        out: out.clone(),
        layers: Layers::from(&[format!("seed={seed}")][..]),
        frames: None,
        resume: false,
        adapter: None,
    };
    synthesize(&request, &Silent).expect("the scenario renders");
    out
}

pub fn navigate_descent(images: &Path, out: &Path) {
    let request = LandRequest { folder: images.into(), out: out.into(), settings: LandSettings::default() };
    land(&request, &Silent).expect("the descent is navigated");
}

pub fn estimate_tumbling(images: &Path, out: &Path) {
    let request = TumbleRequest { folder: images.into(), out: out.into(), settings: TumbleSettings::default() };
    tumble(&request, &Silent).expect("the motion is estimated");
}

pub fn value(metrics: &Metrics, name: &str) -> f64 {
    metrics.figure(name).unwrap_or_else(|| panic!("no figure '{name}' in {metrics:?}"))
}

/// The demonstration's descent, navigated from its pictures: the lander's place above the ground point that it tracks,
/// its speed and its tilt converge from ±1000 m, ±10 m/s and ±2°, and the errors agree with the filter's own covariance.
fn descent_converges(seed: u64) {
    let folder = TempDir::new().expect("a temporary folder");
    let images = dataset("mars_descent_small.toml", seed, folder.path());
    let result = folder.path().join("landing");
    navigate_descent(&images, &result);
    let metrics = evaluate_result(&result, &images).expect("the result is evaluated");
    for (name, most) in [
        ("last_picture_from_tracked_point_horizontal_error", 0.5),
        ("last_picture_from_tracked_point_z_error", 3.0),
        ("last_picture_speed_error", 0.15),
        ("last_picture_roll_error", 0.05),
        ("last_picture_pitch_error", 0.05),
        ("track_error_median", 0.1),
        ("pair_rotation_error_median", 0.05),
    ] {
        assert!(value(&metrics, name).abs() < most, "{name} = {}", value(&metrics, name));
    }
    assert!(metrics.verdict("converged_from_tracked_point").is_some_and(|v| v.holds), "{:?}", metrics.verdicts);
    page_is_whole(&result);
    // The designated pixel itself is known to 0.1 px: at 9.4 km and 256 px of focal length, 3.7 m an axis.
    assert!(value(&metrics, "last_picture_horizontal_error") < 20.0);
    estimates_without_truth_are_the_same(&images, &result, navigate_descent);
}

/// The page about a real result carries its pictures, plots and tables in itself.
fn page_is_whole(result: &Path) {
    let page = result.with_extension("html");
    write_page(&[result.into()], &page).expect("the page is written");
    let html = std::fs::read_to_string(&page).expect("the page");
    let count = |what: &str| html.matches(what).count();
    assert!(count("<svg") >= 4, "{} plots", count("<svg"));
    assert!(count("data:image/png;base64,") >= 5, "{} pictures", count("data:image/png;base64,"));
    assert!(count("<table") >= 3, "{} tables", count("<table"));
    assert_eq!(count("src=\"http"), 0, "the page needs the network");
}

fn tumbling_converges(seed: u64) {
    let folder = TempDir::new().expect("a temporary folder");
    let images = dataset("tumbling_small.toml", seed, folder.path());
    let result = folder.path().join("tumbling");
    estimate_tumbling(&images, &result);
    let metrics = evaluate_result(&result, &images).expect("the result is evaluated");
    for (name, most) in [
        ("attitude_error_rms", 0.5),
        ("rate_error_rms", 0.05),
        ("worst_inertia_error", 0.03),
        ("track_error_median", 0.1),
    ] {
        assert!(value(&metrics, name).abs() < most, "{name} = {}", value(&metrics, name));
    }
    estimates_without_truth_are_the_same(&images, &result, estimate_tumbling);
}

/// The truth wall: with `truth/` gone, every estimate is the same to the last bit.
fn estimates_without_truth_are_the_same(images: &Path, result: &Path, estimate: fn(&Path, &Path)) {
    std::fs::remove_dir_all(images.join("truth")).expect("the truth was there");
    let again = result.with_extension("again");
    estimate(images, &again);
    for file in ["estimate.csv", "covariance.csv", "tracks.csv", "relative_rotations.csv", "trajectory.tum"] {
        let read = |folder: &Path| std::fs::read(folder.join(file)).expect("a result file");
        assert!(read(result) == read(&again), "{file} changed");
    }
}

#[test]
fn the_descent_converges_from_pixels_seed_1() {
    descent_converges(1);
}

#[test]
fn the_descent_converges_from_pixels_seed_2() {
    descent_converges(2);
}

#[test]
fn the_tumbling_motion_converges_from_pixels_seed_1() {
    tumbling_converges(1);
}

#[test]
fn the_tumbling_motion_converges_from_pixels_seed_2() {
    tumbling_converges(2);
}

/// The check has to be able to fail: pictures in the wrong order are no tumbling motion.
#[test]
fn shuffled_images_do_not_converge() {
    let folder = TempDir::new().expect("a temporary folder");
    let images = dataset("tumbling_small.toml", 3, folder.path());
    let list = images.join("cam0/data.csv");
    let text = std::fs::read_to_string(&list).expect("the list of frames");
    let names: Vec<&str> = text.lines().skip(1).filter_map(|l| l.split_once(',').map(|p| p.1)).collect();
    let mut shuffled = String::from("#timestamp [ns],filename\n");
    for (index, line) in text.lines().skip(1).enumerate() {
        let t_ns = line.split_once(',').expect("two columns").0;
        shuffled += &format!("{t_ns},{}\n", names[index * 7 % names.len()]);
    }
    std::fs::write(&list, shuffled).expect("the list is written");
    let request = TumbleRequest {
        folder: images.clone(),
        out: folder.path().join("result"),
        settings: TumbleSettings::default(),
    };
    let converged = tumble(&request, &Silent).is_ok_and(|_| {
        let metrics = evaluate_result(&request.out, &images).expect("the result is evaluated");
        metrics.figure("attitude_error_rms").is_some_and(|error| error < 0.5)
    });
    assert!(!converged, "a motion was found in shuffled pictures");
}

/// An interrupted data set is completed to the same bytes as an undisturbed one.
#[test]
fn a_resumed_data_set_has_the_same_bytes() {
    let folder = TempDir::new().expect("a temporary folder");
    let request = |out: &str, resume: bool| SynthesizeRequest {
        scenario: Path::new(env!("CARGO_MANIFEST_DIR")).join("datasets/tumbling_small.toml"),
        out: folder.path().join(out),
        layers: Layers::from(&["camera.width_px=64", "camera.height_px=64", "tumbling.frames=5"].map(String::from)[..]),
        frames: None,
        resume,
        adapter: None,
    };
    synthesize(&request("whole", false), &Silent).expect("the scenario renders");
    synthesize(&request("broken", false), &Silent).expect("the scenario renders");
    let broken = folder.path().join("broken");
    for lost in
        ["manifest.json", "cam0/data/2000000000.png", "truth/depth/cam0/3000000000.tiff", "truth/observations.csv"]
    {
        std::fs::remove_file(broken.join(lost)).expect("the file was there");
    }
    std::fs::write(broken.join("truth/.partial-Ab3"), "half a fi").expect("a killed job's leftover");
    synthesize(&request("broken", true), &Silent).expect("the data set is completed");
    let manifest = |out: &str| std::fs::read(folder.path().join(out).join("manifest.json")).expect("a manifest");
    assert!(manifest("whole") == manifest("broken"), "the manifests differ");
    let other = SynthesizeRequest { layers: Layers::from(&["seed=9".into()][..]), ..request("broken", true) };
    assert!(synthesize(&other, &Silent).is_err(), "another scenario was mixed into the data set");
}
