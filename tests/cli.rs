//! The command line as a user meets it: exit codes, one clear error that names the file and the cure, nothing
//! half-written.

mod descriptors;
mod folders;
mod long_folder;
mod masks;
mod montecarlo;
mod outcomes;
mod settings;

use assert_cmd::Command;
use image::{GrayImage, Luma};
use std::path::Path;
use tempfile::TempDir;

fn opnav() -> Command {
    Command::cargo_bin("opnav").expect("the binary is built with the tests")
}

/// Runs, expects exit 1 and one line of error, and returns that line.
fn error_of(command: &mut Command) -> String {
    let output = command.output().expect("the command starts");
    let text = String::from_utf8_lossy(&output.stderr).to_string();
    assert_eq!(output.status.code(), Some(1), "{text}");
    let errors: Vec<&str> = text.lines().filter(|line| line.starts_with("error:")).collect();
    assert_eq!(errors.len(), 1, "one error expected: {text}");
    assert!(!text.contains("panicked"), "{text}");
    errors[0].to_string()
}

fn assert_names(error: &str, words: &[&str]) {
    for word in words {
        assert!(error.contains(word), "'{word}' is not in: {error}");
    }
}

fn picture(path: &Path, width: u32, height: u32) {
    GrayImage::from_fn(width, height, |x, y| Luma([(x * 7 + y * 13) as u8])).save(path).expect("a picture is written");
}

/// A plain folder of two readable pictures and a camera file.
fn image_folder() -> TempDir {
    let folder = TempDir::new().expect("a temporary folder");
    picture(&folder.path().join("a1.png"), 64, 64);
    picture(&folder.path().join("a2.png"), 64, 64);
    let camera = "resolution: [64, 64]\nintrinsics: [60.0, 60.0, 31.5, 31.5]\ndistortion_model: none\n";
    std::fs::write(folder.path().join("sensor.yaml"), camera).expect("a camera file is written");
    folder
}

/// Tracks the folder into a result beside it, which must not come into being.
fn tracking_error(folder: &Path, more: &[&str]) -> String {
    let result = TempDir::new().expect("a temporary folder");
    let out = result.path().join("result");
    let error = error_of(opnav().arg("track").arg(folder).arg("--out").arg(&out).args(more));
    assert!(!out.exists(), "a failed job left {}", out.display());
    error
}

fn small_scenario(folder: &Path, addition: &str) -> std::path::PathBuf {
    let text = include_str!("../datasets/tumbling_small.toml");
    let path = folder.join("scenario.toml");
    std::fs::write(&path, format!("{addition}\n{text}")).expect("a scenario is written");
    path
}

#[test]
fn wrong_usage_exits_with_2() {
    opnav().arg("fly").assert().code(2);
    opnav().args(["track", "somewhere"]).assert().code(2);
    opnav().args(["track", "somewhere", "--out", "x", "--frames", "5..2"]).assert().code(2);
    opnav().args(["track", "somewhere", "--out", "x", "--fov-deg", "181"]).assert().code(2);
}

#[test]
fn every_subcommand_explains_itself() {
    for command in [
        "doctor",
        "demo",
        "render",
        "track",
        "land",
        "map",
        "tumble",
        "montecarlo",
        "evaluate",
        "report",
        "bench",
        "export",
        "reference",
    ] {
        let output = opnav().args([command, "--help"]).assert().success().get_output().stdout.clone();
        assert!(String::from_utf8_lossy(&output).contains("Usage:"), "{command}");
    }
}

#[test]
fn reference_prints_every_key() {
    let committed = |name: &str| {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("datasets").join(name);
        std::fs::read_to_string(path).expect("the reference")
    };
    let (scenario, settings) = (committed("REFERENCE.md"), committed("SETTINGS.md"));
    opnav().arg("reference").assert().success().stdout(format!("{scenario}\n{settings}"));
    opnav().args(["reference", "scenario"]).assert().success().stdout(scenario);
    opnav().args(["reference", "settings"]).assert().success().stdout(settings);
}

#[test]
fn doctor_names_opencv_and_an_adapter() {
    let output = opnav().args(["doctor", "--json"]).assert().success().get_output().stdout.clone();
    let found: serde_json::Value = serde_json::from_slice(&output).expect("one JSON object and nothing else");
    assert!(found["opencv_version"].as_str().is_some_and(|v| v.starts_with('4')), "{found}");
    assert!(found["default_adapter"].is_string(), "{found}");
}

#[test]
fn doctor_without_an_adapter_says_what_to_install() {
    let output = opnav().arg("doctor").envs(no_adapter()).assert().code(1).get_output().stdout.clone();
    assert_names(&String::from_utf8_lossy(&output), &["missing", "mesa-vulkan-drivers"]);
}

/// Hides every Vulkan driver from the loader.
fn no_adapter() -> [(&'static str, &'static str); 2] {
    [("VK_DRIVER_FILES", "/nonexistent.json"), ("VK_ICD_FILENAMES", "/nonexistent.json")]
}

#[test]
fn rendering_without_an_adapter_says_what_to_install() {
    let folder = TempDir::new().expect("a temporary folder");
    let scenario = small_scenario(folder.path(), "");
    let out = folder.path().join("out");
    let error = error_of(opnav().arg("render").arg(scenario).arg("--out").arg(&out).envs(no_adapter()));
    assert_names(&error, &["adapter", "mesa-vulkan-drivers"]);
    assert!(!out.exists(), "a failed job left {}", out.display());
}

#[test]
fn an_unknown_key_of_a_scenario_is_named() {
    let folder = TempDir::new().expect("a temporary folder");
    let scenario = small_scenario(folder.path(), "colour = \"red\"");
    let out = folder.path().join("out");
    let error = error_of(opnav().arg("render").arg(scenario).arg("--out").arg(&out));
    assert_names(&error, &["scenario.toml", "colour"]);
    assert!(!out.exists(), "a failed job left {}", out.display());
}

#[test]
fn an_impossible_value_of_a_scenario_is_named() {
    let folder = TempDir::new().expect("a temporary folder");
    let scenario = small_scenario(folder.path(), "");
    let out = folder.path().join("out");
    let error =
        error_of(opnav().arg("render").arg(scenario).args(["--set", "camera.fov_deg=-3.0"]).arg("--out").arg(&out));
    assert_names(&error, &["fov_deg", "-3"]);
    assert!(!out.exists(), "a failed job left {}", out.display());
}

#[test]
fn a_folder_in_use_is_left_alone() {
    let folder = TempDir::new().expect("a temporary folder");
    let scenario = small_scenario(folder.path(), "");
    let error = error_of(opnav().arg("render").arg(&scenario).arg("--out").arg(folder.path()));
    assert_names(&error, &["not empty", "--resume"]);
    assert_eq!(std::fs::read_dir(folder.path()).expect("the folder").count(), 1);
}

#[test]
fn a_folder_without_images_is_named() {
    let folder = TempDir::new().expect("a temporary folder");
    assert_names(
        &tracking_error(folder.path(), &["--fov-deg", "60"]),
        &["no pictures", &folder.path().display().to_string()],
    );
}

#[test]
fn a_folder_that_is_not_there_is_named() {
    assert_names(&tracking_error(Path::new("/nonexistent/pictures"), &[]), &["/nonexistent/pictures", "missing"]);
}

/// Mean grey level of the overlay that tracking draws over two textured pictures whose numbers fill `bits`; their camera
/// file states `stated` bits.
fn overlay_brightness(bits: u32, stated: &str) -> f64 {
    let folder = TempDir::new().expect("a temporary folder");
    let number = |x: u32, y: u32| (x / 9).wrapping_mul(2_654_435_761).wrapping_add((y / 9).wrapping_mul(40_503)) % 199;
    for (name, shift) in [("a1.png", 0), ("a2.png", 3)] {
        let deep = |x, y| Luma([((number(x + shift, y) + 40) * ((1 << bits) - 1) / 255) as u16]);
        let picture = image::ImageBuffer::from_fn(192, 192, deep);
        picture.save(folder.path().join(name)).expect("a picture is written");
    }
    let camera = "resolution: [192, 192]\nintrinsics: [180.0, 180.0, 95.5, 95.5]\ndistortion_model: none\n";
    std::fs::write(folder.path().join("sensor.yaml"), format!("{camera}{stated}")).expect("a camera file is written");
    let out = folder.path().join("result");
    opnav().arg("track").arg(folder.path()).arg("--out").arg(&out).assert().success();
    let overlays =
        std::fs::read_dir(out.join("overlays")).expect("overlays").map(|entry| entry.expect("an entry").path());
    let overlay = image::open(overlays.last().expect("an overlay")).expect("a picture").into_luma8();
    overlay.pixels().map(|p| f64::from(p[0])).sum::<f64>() / f64::from(overlay.width() * overlay.height())
}

#[test]
fn overlays_of_12_bit_images_are_as_bright_as_those_of_16_bits() {
    let deep = overlay_brightness(16, "");
    assert!((overlay_brightness(12, "bits: 12\n") - deep).abs() < 2.0, "{deep}");
    assert!((overlay_brightness(12, "") - deep).abs() < 2.0, "bits that are not stated are found");
    assert!(overlay_brightness(12, "bits: 16\n") < 0.3 * deep, "bits that are stated wrongly are believed");
}

#[test]
fn one_image_is_too_few() {
    let folder = image_folder();
    std::fs::remove_file(folder.path().join("a2.png")).expect("the picture was there");
    assert_names(&tracking_error(folder.path(), &[]), &["two"]);
}

#[test]
fn an_unreadable_image_is_named() {
    let folder = image_folder();
    std::fs::write(folder.path().join("a2.png"), b"not a picture").expect("the file is written");
    assert_names(&tracking_error(folder.path(), &[]), &["a2.png", "cannot be read"]);
}

#[test]
fn a_image_of_the_wrong_size_is_named() {
    let folder = image_folder();
    picture(&folder.path().join("a2.png"), 32, 64);
    assert_names(&tracking_error(folder.path(), &[]), &["a2.png", "32x64", "64x64"]);
}

#[test]
fn a_missing_camera_file_is_named_with_the_cure() {
    let folder = image_folder();
    std::fs::remove_file(folder.path().join("sensor.yaml")).expect("the file was there");
    assert_names(&tracking_error(folder.path(), &[]), &["sensor.yaml", "--camera", "--fov-deg"]);
}

#[test]
fn a_value_that_is_not_a_number_is_named_with_its_line() {
    let folder = image_folder();
    let root = folder.path();
    std::fs::create_dir_all(root.join("cam0/data")).expect("a folder");
    std::fs::create_dir_all(root.join("imu0")).expect("a folder");
    std::fs::rename(root.join("sensor.yaml"), root.join("cam0/sensor.yaml")).expect("moved");
    picture(&root.join("cam0/data/0.png"), 64, 64);
    picture(&root.join("cam0/data/1.png"), 64, 64);
    let imu = "rate_hz: 100.0\ngyroscope_noise_density: 1e-6\naccelerometer_noise_density: 1e-4\n";
    std::fs::write(root.join("imu0/sensor.yaml"), imu).expect("written");
    std::fs::write(root.join("imu0/data.csv"), "#t,a,b,c,d,e,f\n0,0,0,0,0,0,3.7\n10000000,0,NaN,0,0,0,3.7\n")
        .expect("written");
    let out = root.join("result");
    let error = error_of(opnav().arg("land").arg(root).arg("--out").arg(&out));
    assert_names(&error, &["imu0/data.csv", "line 3", "NaN"]);
    assert!(!out.exists(), "a failed job left {}", out.display());
}

#[test]
fn a_result_without_truth_is_named() {
    let folder = TempDir::new().expect("a temporary folder");
    let error = error_of(opnav().arg("evaluate").arg(folder.path()).arg("--truth").arg(folder.path()));
    assert_names(&error, &["summary.json"]);
}
